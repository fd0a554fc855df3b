"""A cloud or a mesh in a file as a rigid template."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from regkit.alignment import cloud_body, cloud_description
from regkit.body import Body, BodyDescription
from regkit.clouds import read_cloud, voxel_downsampled
from regkit.clouds.checks import check_shape
from regkit.config.model import InputPath
from regkit.interfaces.template import Template
from regkit.skeleton.joints import Vector
from regkit.system.arrays import Array


class CloudTemplate(Template):
    """A rigid object: one free segment, whose surface are the points of a cloud or of a mesh.

    The segment's origin is the middle of the points; markers are given where the file has them.
    """

    kind: Literal["cloud"] = "cloud"
    path: InputPath
    """The file: a cloud (.ply, .pcd, .xyz, .npz, ...) or a mesh (.ply, .stl, .obj, ...)."""
    voxel: Annotated[float, Field(gt=0.0)] | None = None
    """Side of the cubes whose points are averaged to one [m]; every point is taken without it."""
    markers: dict[str, Vector] = Field(default_factory=dict)
    """Named points in the file's coordinates [m], to be compared with reference points."""

    def description(self) -> BodyDescription:
        """One free segment.

        Raises:
            DataError: If the file cannot be read, or its points do not determine a pose.
        """
        points = self._points()
        return cloud_description(points, self._markers(points))

    def given_size(self) -> float | None:
        """The diagonal of the box around the points [m]."""
        return float(np.linalg.norm(np.ptp(self._points(), axis=0)))

    def name(self) -> str:
        """The file's name."""
        return self.path.stem

    def body(self, size: float) -> Body:
        """The points as they are; a cloud has one size."""
        points = self._points()
        return cloud_body(self.name(), points - points.mean(axis=0), self._markers(points))

    def _points(self) -> Array:
        changed = self.path.stat().st_mtime_ns if self.path.is_file() else 0
        points = _read(self.path, changed)
        return points if self.voxel is None else voxel_downsampled(points, self.voxel)

    def _markers(self, points: Array) -> dict[str, Array]:
        centre = points.mean(axis=0)
        return {name: np.array(at) - centre for name, at in self.markers.items()}


@lru_cache(maxsize=8)
def _read(path: Path, changed: int) -> Array:
    """The points of a file, which is read again only if it has changed."""
    points = read_cloud(path)
    check_shape(points, place=str(path))
    return points
