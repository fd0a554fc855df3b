"""The point-to-point kernel: distances of data to the nearest vertices."""

from __future__ import annotations

from typing import Literal

from regkit.observation import Observation
from regkit.primitives import Placed
from regkit.primitives.surfels import Surfels
from regkit_plugins.kernels.point_to_plane.correspondences import BoundMatching
from regkit_plugins.kernels.point_to_plane.matching import MatchingKernel


class PointToPoint(MatchingKernel):
    """Distance of each data point to the nearest surfel, which is continuous in the pose.

    Vertices do not slide along the data, so the body tends to lag behind motion between frames.
    """

    kind: Literal["point_to_point"] = "point_to_point"

    def bind(
        self, observation: Observation, start: Placed[Surfels], *, smoothing: float = 0.0
    ) -> BoundMatching:
        """Binds the kernel to the data of a frame."""
        return BoundMatching(self, observation, start, smoothing, point_share=1.0)
