"""Ground truth: reference joint positions of a recording."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.geometry.camera import MAX_DISTANCE
from regkit.system.arrays import Array
from regkit.system.brief import Brief
from regkit.system.errors import DataError


@dataclass(frozen=True)
class Truth(Brief):
    """Reference positions of J named joints in T frames.

    Attributes:
        joints: Names of the joints, (J,).
        positions: Positions in the frame of the points, (T, J, 3) [m]; NaN where unknown.
    """

    joints: tuple[str, ...]
    positions: Array

    def __post_init__(self) -> None:
        """Raises DataError if a position is beyond ``MAX_DISTANCE``."""
        far = np.argwhere(np.abs(self.positions) > MAX_DISTANCE)
        if len(far):
            frame, joint, _ = (int(index) for index in far[0])
            name = self.joints[joint] if joint < len(self.joints) else joint
            raise DataError(
                f"the reference of joint '{name}' in frame {frame} is "
                f"{self.positions[frame, joint].tolist()}, beyond any measurement; it is in metres"
            )
