"""Observations: a frame as a kernel wants it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from regkit.geometry.camera import Camera
from regkit.observation.silhouette import Silhouette
from regkit.system.arrays import Array
from regkit.system.errors import DataError


@dataclass(frozen=True)
class Observation:
    """Data as a sum of N isotropic Gaussians, eq. 2.

    Attributes:
        points: Means, (N, 3) [m].
        weights: (N,).
        variances: sigma^2 of each, (N,) [m^2]. A kernel's time grows with the number of different
            values, so a preprocessor that has many rounds them.
        camera: The camera, if it is known; it looks along z from the origin.
        depth: The depth image (H, W) [m] that the points come from, zero where nothing was
            measured, if there is one.
        normals: Unit normals of the surface at the points, (N, 3), of either sign, if they are
            known.

    Raises:
        DataError: If there is no point, or the arrays differ in length.
    """

    points: Array
    weights: Array
    variances: Array
    camera: Camera | None = None
    depth: Array | None = None
    normals: Array | None = None

    def __post_init__(self) -> None:
        """Refuse data from which no kernel can compute anything.

        Raises:
            DataError: If there is no point, or the arrays differ in length.
        """
        count = len(self.points)
        if not count:
            raise DataError("the observation has no points; a registration needs some")
        for name in ("weights", "variances"):
            if getattr(self, name).shape != (count,):
                raise DataError(
                    f"the observation has {count} points, but {name} of the shape "
                    f"{getattr(self, name).shape}; it must be ({count},)"
                )

    @cached_property
    def silhouette(self) -> Silhouette | None:
        """What the depth image says of free space, if there is one."""
        if self.camera is None or self.depth is None:
            return None
        return Silhouette(self.camera, self.depth)
