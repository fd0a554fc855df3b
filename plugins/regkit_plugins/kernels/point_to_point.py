"""Point to point: the distance of data to the nearest vertices."""

from __future__ import annotations

from typing import Literal

from regkit.observation import Observation
from regkit.primitives import Placed
from regkit.primitives.surfels import Surfels
from regkit_plugins.kernels.point_to_plane.correspondences import BoundMatching
from regkit_plugins.kernels.point_to_plane.matching import MatchingKernel


class PointToPoint(MatchingKernel):
    """The distance of each data point to the nearest surfel, which is continuous in the pose.

    Vertices cannot slide along the data: between two frames it is drawn to where it was.
    """

    kind: Literal["point_to_point"] = "point_to_point"

    def bind(
        self, observation: Observation, start: Placed[Surfels], *, smoothing: float = 0.0
    ) -> BoundMatching:
        """Bind the kernel to a frame's data."""
        return BoundMatching(self, observation, start, smoothing, point_share=1.0)
