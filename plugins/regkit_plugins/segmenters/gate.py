"""The gate: removes what is far from the body's last pose."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from regkit.config.quantities import Length
from regkit.interfaces import BoundSegmenter, Expected, Recording, Segmenter, Template
from regkit.observation import Frame

DISTANCE, FPS = 0.15, 30.0
"""Default distance, as a fraction of the body's size: a fast arm's way between two frames of a
camera with the usual rate [1/s]. At a lower rate it goes farther."""


class Gate(Segmenter):
    """Removes points farther from the last body than it may have moved.

    It has no effect before the start and where the last motion is unknown: in the first two frames,
    in which a tracker may still correct a limb of the start, and after frames without data. The
    last motion of each part adds to its distance.
    """

    kind: Literal["gate"] = "gate"

    distance: Length | None = None
    """Largest distance from the last body [m]; by default 15 % of the body's size at 30 frames per
    second, and more at a lower rate."""

    def bind(self, recording: Recording, template: Template) -> BoundGate:
        """Binds the gate, which reads no frame."""
        return BoundGate(self.distance, DISTANCE * max(1.0, FPS / recording.fps))


@dataclass(frozen=True)
class BoundGate(BoundSegmenter):
    """``Gate`` bound to a recording.

    Attributes:
        distance: Largest distance from the last body [m], or None for a fraction of its size.
        fraction: This fraction.
    """

    distance: float | None
    fraction: float

    def segmented(self, frame: Frame, expected: Expected | None) -> Frame:
        """Returns the frame with the points near the last body."""
        if expected is None or expected.before is None:
            return frame
        distance = self.distance or self.fraction * expected.body.size
        return frame.only(expected.within(frame.points, distance))
