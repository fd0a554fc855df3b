"""Flat Gaussians at the points of a body's surface."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from regkit.gaussians.cloud_shape import CloudShape


class CloudGeneralizedSumOfGaussians(CloudShape):
    """A Gaussian at each point of the body's surface that is flat as the surface is there.

    Its plane is that of the point's neighbourhood, as in generalized ICP (Segal, Haehnel, Thrun,
    Generalized-ICP, 2009, section III.B).
    """

    kind: Literal["cloud_gsog"] = "cloud_gsog"

    flatness: Annotated[float, Field(gt=0.0, le=1.0)] = 0.2
    """Standard deviation along the surface's normal, as a part of that in the surface."""

    def flat(self) -> float:
        """The given flatness."""
        return self.flatness
