"""Ground truth: reference joint positions of a recording."""

from __future__ import annotations

from dataclasses import dataclass

from regkit.system.arrays import Array
from regkit.system.brief import Brief


@dataclass(frozen=True)
class Truth(Brief):
    """Reference positions of J named joints in T frames.

    Attributes:
        joints: Names of the joints, (J,).
        positions: Positions in the frame of the points, (T, J, 3) [m]; NaN where unknown.
    """

    joints: tuple[str, ...]
    positions: Array
