"""Point to point: the distance of data to the nearest vertices."""

from __future__ import annotations

from typing import Literal

from regkit.observation import Observation
from regkit.primitives import Placed
from regkit.primitives.surfels import Surfels
from regkit_plugins.kernels.point_to_plane.correspondences import MatchingSimilarity
from regkit_plugins.kernels.point_to_plane.matching import MatchingKernel


class PointToPoint(MatchingKernel):
    """The distance of each data point to the nearest surfel, which is continuous in the pose.

    Vertices cannot slide along the data: between two frames it is drawn to where it was.
    """

    kind: Literal["point_to_point"] = "point_to_point"

    def against(
        self, observation: Observation, start: Placed[Surfels], *, blur: float = 0.0
    ) -> MatchingSimilarity:
        """Bind the kernel to a frame's data."""
        return MatchingSimilarity(self, observation, start, blur, point_share=1.0)
