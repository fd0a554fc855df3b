"""Observations: preprocessed frames, the data that kernels compare with."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from regkit.geometry.camera import Camera
from regkit.observation.arrays import ObservationArrays
from regkit.observation.landmarks import Landmarks
from regkit.observation.silhouette import Silhouette
from regkit.system.arrays import Array
from regkit.system.brief import Brief
from regkit.system.errors import DataError


@dataclass(frozen=True)
class Observation(Brief):
    """Data as a sum of N isotropic Gaussians, eq. 2.

    Attributes:
        points: Means in the camera frame, (N, 3) [m].
        weights: Weights, (N,).
        variances: Variances sigma^2, (N,) [m^2]. The run time of a kernel grows with the number of
            distinct values, so a preprocessor should round them.
        camera: Intrinsics, or None if unknown; the camera is at the origin and looks along z.
        depth: Depth image of the points, (H, W) [m]; None if there is none. As in a ``Frame``, zero
            marks free space and NaN an unknown pixel.
        normals: Unit normals of arbitrary sign at the points, (N, 3); None if unknown.
        landmarks: Measured positions of points of the body; None without any.

    Raises:
        DataError: If there is no point, or the arrays differ in length.
    """

    points: Array
    weights: Array
    variances: Array
    camera: Camera | None = None
    depth: Array | None = None
    normals: Array | None = None
    landmarks: Landmarks | None = None

    def __post_init__(self) -> None:
        """Validates the arrays.

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
        """The free space of the depth image; None without a depth image."""
        if self.camera is None or self.depth is None:
            return None
        return Silhouette(self.camera, self.depth)

    @cached_property
    def arrays(self) -> ObservationArrays | None:
        """The data as compiled functions take them; None if the variances differ."""
        return ObservationArrays.of(self)
