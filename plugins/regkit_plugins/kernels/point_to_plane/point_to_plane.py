"""The point-to-plane kernel: distances of data to the tangent planes of the nearest vertices."""

from __future__ import annotations

from typing import Literal

from regkit.config.quantities import Share
from regkit.observation import Observation
from regkit.primitives import Placed
from regkit.primitives.surfels import Surfels
from regkit_plugins.kernels.point_to_plane.correspondences import BoundMatching
from regkit_plugins.kernels.point_to_plane.matching import MatchingKernel, given_normals


class PointToPlane(MatchingKernel):
    """Distance of each data point to the plane through the nearest surfel.

    Surfaces may slide along themselves, so that it needs far fewer iterations than point to point.
    The energy may jump slightly where the nearest surfel, and with it the plane, changes.

    Source: Chen, Medioni, Object modelling by registration of multiple range images, Image and
    Vision Computing 10, 1992.
    """

    kind: Literal["point_to_plane"] = "point_to_plane"

    normals: Literal["model", "data"] = "model"
    """Planes of the surfels, which rotate with their segments, or of the data, with normals from
    the preprocessor."""
    point_share: Share = 0.1
    """Fraction of the squared point-to-point distance in the residual, which keeps the ends of
    limbs in place; one is equivalent to point_to_point."""

    def bind(
        self, observation: Observation, start: Placed[Surfels], *, smoothing: float = 0.0
    ) -> BoundMatching:
        """Binds the kernel to the data of a frame.

        Raises:
            ConfigError: If the data's normals are required but missing.
        """
        normals = given_normals(observation, "normals") if self.normals == "data" else None
        return BoundMatching(
            self, observation, start, smoothing, point_share=self.point_share, normals=normals
        )
