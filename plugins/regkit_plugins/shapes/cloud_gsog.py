"""The shape model of flat Gaussians at the points of a surface."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from regkit.gaussians.cloud_shape import CloudShape


class CloudGeneralizedSumOfGaussians(CloudShape):
    """A flat Gaussian at each point of the body's surface.

    Its plane is estimated from the point's neighbourhood, as in generalized ICP (Segal, Haehnel,
    Thrun, Generalized-ICP, 2009, section III.B).
    """

    kind: Literal["cloud_gsog"] = "cloud_gsog"

    flatness: Annotated[float, Field(ge=1e-3, le=1.0)] = 0.2
    """Standard deviation along the normal, as a fraction of that in the tangent plane."""

    def flat(self) -> float:
        """Returns the flatness."""
        return self.flatness
