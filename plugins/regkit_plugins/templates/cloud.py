"""The template of a rigid cloud or mesh in a file."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import Field

from regkit.alignment import cloud_body, cloud_description
from regkit.body import Body, BodyDescription
from regkit.body.checks import LONGEST
from regkit.clouds import read_cloud, voxel_downsampled
from regkit.clouds.checks import check_shape
from regkit.config.model import InputPath
from regkit.config.quantities import Voxel
from regkit.interfaces.template import Template
from regkit.skeleton.joints import Position
from regkit.system.arrays import Array
from regkit.system.errors import DataError


class CloudTemplate(Template):
    """A rigid object: one free segment with the points of a cloud or mesh as its surface.

    The origin of the segment is the centroid of the points.
    """

    kind: Literal["cloud"] = "cloud"
    path: InputPath
    """File of a cloud (.ply, .pcd, .xyz, .npz, ...) or a mesh (.ply, .stl, .obj, ...)."""
    voxel: Voxel | None = None
    """Voxel size for downsampling [m]; by default all points are used."""
    markers: dict[str, Position] = Field(default_factory=dict)
    """Named points in the coordinates of the file [m], for comparison with reference points."""

    def description(self) -> BodyDescription:
        """Returns a description with one free segment.

        Raises:
            DataError: If the file cannot be read, or its points do not determine a pose.
        """
        points = self._points()
        return cloud_description(points, self._markers(points))

    def given_size(self) -> float | None:
        """Returns the diagonal of the bounding box [m]."""
        return float(np.linalg.norm(np.ptp(self._points(), axis=0)))

    def name(self) -> str:
        """Returns the name of the file."""
        return self.path.stem

    def body(self, size: float) -> Body:
        """Returns the body; the size of a cloud is fixed, so ``size`` is ignored."""
        points = self._points()
        return cloud_body(self.name(), points - points.mean(axis=0), self._markers(points))

    def _points(self) -> Array:
        changed = self.path.stat().st_mtime_ns if self.path.is_file() else 0
        points = _read(self.path, changed)
        return points if self.voxel is None else voxel_downsampled(points, self.voxel)

    def _markers(self, points: Array) -> dict[str, Array]:
        """Returns the markers relative to the centroid; one far from the points is refused."""
        centre, extent = points.mean(axis=0), float(np.linalg.norm(np.ptp(points, axis=0)))
        markers = {name: np.array(at) - centre for name, at in self.markers.items()}
        for name, at in markers.items():
            if (far := float(np.linalg.norm(at))) > LONGEST * extent:
                raise DataError(
                    f"the marker '{name}' is {far:.3g} m from an object of {extent:.3g} m",
                    place=str(self.path),
                )
        return markers


@lru_cache(maxsize=8)
def _read(path: Path, changed: int) -> Array:
    """Returns the points of a file, cached until it changes."""
    points = read_cloud(path)
    check_shape(points, place=str(path))
    return points
