"""What cameras would show of a body: by one silhouette, or by those of several cameras."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from regkit.geometry.rigid import transformed
from regkit.observation.silhouette import Silhouette
from regkit.system.arrays import Array


class Sight(Protocol):
    """What is seen; a ``Silhouette`` is the sight of one camera."""

    def observable(self, points: Array, margins: Array | float = np.inf) -> NDArray[np.bool_]:
        """Returns which points (M,) would be shown if something were there.

        Args:
            points: Points, (M, 3) [m].
            margins: Distance behind a measured depth from which on a point is hidden, (M,) or for
                all points [m]; by default none is.
        """


@dataclass(frozen=True)
class SharedSight(Sight):
    """The sight of several cameras: what at least one of them would show.

    Attributes:
        cameras: T_camera_world (4, 4) [m] and silhouette of each camera.
    """

    cameras: Sequence[tuple[Array, Silhouette]]

    def observable(self, points: Array, margins: Array | float = np.inf) -> NDArray[np.bool_]:
        """Returns which points (M,) in the world at least one camera would show."""
        shown = np.zeros(len(points), dtype=bool)
        for T_camera_world, silhouette in self.cameras:
            shown |= silhouette.observable(transformed(T_camera_world, points), margins)
        return shown
