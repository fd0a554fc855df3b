"""A pose that may explain a frame."""

from __future__ import annotations

from dataclasses import dataclass

from regkit.body import Body
from regkit.skeleton import Pose


@dataclass(frozen=True)
class Exemplar:
    """A pose that may explain a frame.

    Attributes:
        body: The body at a size.
        pose: Its pose.
        disagreement: Disagreement of the rendered body with the data, from 0 to 1.
    """

    body: Body
    pose: Pose
    disagreement: float
