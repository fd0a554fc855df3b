"""The shape model of isotropic Gaussians at the points of a surface."""

from __future__ import annotations

from typing import Literal

from regkit.gaussians.cloud_shape import CloudShape


class CloudSumOfGaussians(CloudShape):
    """An isotropic Gaussian at each point of the body's surface."""

    kind: Literal["cloud_sog"] = "cloud_sog"

    def flat(self) -> float:
        """Returns 1: the Gaussians are isotropic."""
        return 1.0
