"""Trajectories of markers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.geometry.camera import MAX_DISTANCE
from regkit.system.arrays import Array
from regkit.system.brief import Brief
from regkit.system.errors import DataError


@dataclass(frozen=True)
class Trajectories(Brief):
    """Positions of M markers in T frames.

    Attributes:
        names: Names of the markers, (M,).
        fps: Frame rate [1/s].
        positions: Positions in the laboratory, (T, M, 3) [m]; NaN where unmeasured.

    Raises:
        DataError: If two markers have a name, or a number cannot be right.
    """

    names: tuple[str, ...]
    fps: float
    positions: Array

    def __post_init__(self) -> None:
        """Validates names and numbers."""
        if not len(self.positions) or not self.names:
            raise DataError("there is no frame with markers in it")
        if len(set(self.names)) < len(self.names):
            twice = next(name for name in self.names if self.names.count(name) > 1)
            raise DataError(f"two markers are called '{twice}'")
        if not 1e-3 < self.fps < 1e5:
            raise DataError(f"the frame rate is {self.fps:g}")
        far = np.argwhere(np.abs(self.positions) > MAX_DISTANCE)
        if len(far) or np.isinf(self.positions).any():
            frame, marker = far[0][:2] if len(far) else (0, 0)
            raise DataError(
                f"marker '{self.names[marker]}' is beyond any laboratory in frame {frame}; is the "
                "unit right?"
            )
