"""The start by landmarks: the pose and size that bring the markers to them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from regkit.interfaces import Start, StartSearch, Template
from regkit.observation import Observation
from regkit.start.landmarks import landmark_start


class LandmarkStart(StartSearch):
    """Fits the pose in the first frame, and the size, to the landmarks alone.

    Every stance is tried from four sides, with y up in the picture. The points of the frame only
    say where to begin.
    """

    kind: Literal["landmarks"] = "landmarks"

    def find(self, template: Template, observations: Sequence[Observation]) -> Start:
        """Returns the pose and size of least distance to the landmarks.

        Raises:
            DataError: If the first frame has no landmarks of the template's markers.
        """
        return landmark_start(template.body, template.candidate_sizes(), observations[0])
