"""The point preprocessor: every point or voxel as a Gaussian of the same variance."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field, model_validator

from regkit.clouds import normals, surface_downsampled, voxel_downsampled
from regkit.config.quantities import Length, Voxel
from regkit.interfaces import Preprocessor
from regkit.observation import Frame, Observation
from regkit.observation.crop import Crop


class PointsPreprocessor(Preprocessor):
    """A sum of Gaussians with a uniform variance, section 3 of the paper."""

    kind: Literal["points"] = "points"

    sigma: Length = 0.02
    """Standard deviation of each Gaussian [m]."""
    voxel: Voxel | None = None
    """Voxel size for downsampling [m]; by default all points are used."""
    drop_stray: bool = False
    """Leave out voxels with hardly a point, such as those of flying pixels and of points spread
    over the scene. The cloud's own distribution of densities tells what is hardly, so that an
    evenly thin cloud keeps all. It needs ``voxel``."""
    normals: Annotated[int, Field(ge=3, le=1000)] | None = None
    """Number of neighbours for normal estimation; by default there are no normals."""
    crop: Crop = Crop()
    """Crop that segments the object."""

    @model_validator(mode="after")
    def _stray_in_voxels(self) -> PointsPreprocessor:
        if self.drop_stray and self.voxel is None:
            raise ValueError("drop_stray needs voxel: stray points are told by how few are in one")
        return self

    def preprocess(self, frame: Frame) -> Observation:
        """Returns one Gaussian of weight 1 per point or voxel.

        Downsampling also equalises the sampling density of near and far surfaces.

        Raises:
            DataError: If too few points remain after cropping or downsampling.
        """
        frame = self.crop.cropped(frame)
        points = frame.points
        if self.voxel is not None:
            downsampled = surface_downsampled if self.drop_stray else voxel_downsampled
            points = downsampled(points, self.voxel)
            self.crop.check_downsampled(len(points), frame, "voxel", self.voxel)
        ones = np.ones(len(points))
        return Observation(
            points,
            ones,
            self.sigma**2 * ones,
            frame.camera,
            frame.depth,
            # A neighbourhood includes the point itself.
            None if self.normals is None else normals(points, self.normals + 1),
            frame.landmarks,
        )
