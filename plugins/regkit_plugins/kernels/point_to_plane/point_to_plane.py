"""Point to plane: the distance of data to the tangent planes of the nearest vertices."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from regkit.observation import Observation
from regkit.primitives import Placed
from regkit.primitives.surfels import Surfels
from regkit_plugins.kernels.point_to_plane.correspondences import BoundMatching
from regkit_plugins.kernels.point_to_plane.matching import MatchingKernel, given_normals


class PointToPlane(MatchingKernel):
    """The distance of each data point to the plane through the nearest surfel.

    A surface may slide along itself, so that a few rounds suffice where points to points take many.
    Where the nearest surfel changes, the energy may jump a little, for its plane is another one.

    Source: Chen, Medioni, Object modelling by registration of multiple range images, Image and
    Vision Computing 10, 1992.
    """

    kind: Literal["point_to_plane"] = "point_to_plane"

    normals: Literal["model", "data"] = "model"
    """Whose planes: those of the surfels, which turn with their segments, or those of the data,
    which the preprocessor has to give."""
    point_share: Annotated[float, Field(ge=0.0, le=1.0)] = 0.1
    """Share of the squared distance to the point itself in that to the plane, which keeps ends of
    limbs where they are; with one it is point_to_point."""

    def bind(
        self, observation: Observation, start: Placed[Surfels], *, smoothing: float = 0.0
    ) -> BoundMatching:
        """Bind the kernel to a frame's data.

        Raises:
            ConfigError: If the data's normals are needed, and there are none.
        """
        normals = given_normals(observation, "normals") if self.normals == "data" else None
        return BoundMatching(
            self, observation, start, smoothing, point_share=self.point_share, normals=normals
        )
