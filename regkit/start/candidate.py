"""A body and pose that may explain the data."""

from __future__ import annotations

from dataclasses import dataclass

from regkit.body import Body
from regkit.skeleton import Pose


@dataclass(frozen=True)
class Candidate:
    """A body and pose that may explain the data.

    Attributes:
        body: The body at a size.
        pose: Its pose.
        misfit: Misfit to the data, dimensionless; lower is better.
    """

    body: Body
    pose: Pose
    misfit: float
