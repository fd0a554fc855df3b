"""Round Gaussians at the points of a body's surface."""

from __future__ import annotations

from typing import Literal

from regkit.gaussians.cloud_shape import CloudShape


class CloudSumOfGaussians(CloudShape):
    """A round Gaussian at each point of the body's surface."""

    kind: Literal["cloud_sog"] = "cloud_sog"

    def flat(self) -> float:
        """As deep as it is wide."""
        return 1.0
