"""The preprocessor that makes every point, or every voxel, one Gaussian of the same variance."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from regkit.clouds import normals, voxel_downsampled
from regkit.interfaces import Preprocessor
from regkit.observation import Frame, Observation
from regkit.observation.crop import Crop

Length = Annotated[float, Field(gt=0.0)]


class PointsPreprocessor(Preprocessor):
    """A sum of Gaussians with a uniform variance, section 3 of the paper."""

    kind: Literal["points"] = "points"

    sigma: Length = 0.02
    """Standard deviation of each Gaussian [m]."""
    voxel: Annotated[float, Field(ge=1e-4)] | None = None
    """Side of the cubes whose points are averaged to one [m]; every point counts without it."""
    normals: Annotated[int, Field(ge=3)] | None = None
    """Give each point the normal of the plane through so many of its neighbours; none without."""
    crop: Crop = Crop()
    """What part of the frame is looked at."""

    def preprocess(self, frame: Frame) -> Observation:
        """One Gaussian for each point or voxel, all of weight 1.

        Averaging also evens out how densely a surface is seen: near parts count no more than far
        ones.
        """
        frame = self.crop.cropped(frame)
        points = frame.points
        if self.voxel is not None:
            points = voxel_downsampled(points, self.voxel)
            self.crop.check_thinned(len(points), frame, "voxel", self.voxel)
        ones = np.ones(len(points))
        return Observation(
            points,
            ones,
            self.sigma**2 * ones,
            frame.camera,
            frame.depth,
            # A point is the first of its own neighbours.
            None if self.normals is None else normals(points, self.normals + 1),
        )
