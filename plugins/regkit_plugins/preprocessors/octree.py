"""The octree preprocessor: leaves of an octree as Gaussians of their size."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from regkit.clouds.stray import dense_voxels
from regkit.config.quantities import Count, Voxel
from regkit.interfaces import Preprocessor
from regkit.observation import Frame, Observation
from regkit.observation.crop import Crop
from regkit.system.arrays import Array, Indices


class OctreePreprocessor(Preprocessor):
    """A sum of Gaussians from the leaves of an octree, section 3 of the paper.

    A cell is subdivided until its side is ``leaf`` or it contains at most ``few`` points. A leaf
    becomes a Gaussian at the mean of its points, with half its side as standard deviation and its
    number of points as weight.
    """

    kind: Literal["octree"] = "octree"

    leaf: Voxel = 0.045
    """Side of the smallest cells [m]."""
    few: Count = 2
    """A cell with at most this number of points is not subdivided."""
    largest: Annotated[int, Field(ge=0, le=20)] = 2
    """Number of levels above the smallest cells; the largest cells have the side ``leaf`` times 2
    to this power, which bounds the Gaussians of stray points."""
    drop_stray: bool = False
    """Leave out points in cells with hardly a point, such as flying pixels. The cloud's own
    distribution of densities tells what is hardly, so that an evenly thin cloud keeps all."""
    crop: Crop = Crop()
    """Crop that segments the object."""

    def preprocess(self, frame: Frame) -> Observation:
        """Returns one Gaussian per octree leaf.

        Raises:
            DataError: If too few points remain after cropping or in the leaves.
        """
        frame = self.crop.cropped(frame)
        points = frame.points
        cells = np.floor((points - points.min(axis=0)) / self.leaf).astype(np.int64)
        if self.drop_stray:
            dense = _dense(cells)
            points, cells = points[dense], cells[dense]
        pending = np.arange(len(points))
        means, weights, deviations = [], [], []
        for level in range(self.largest, -1, -1):
            _, cell, counts = np.unique(
                cells[pending] >> level, axis=0, return_inverse=True, return_counts=True
            )
            cell = cell.ravel()
            is_leaf = counts <= self.few if level else np.ones(len(counts), dtype=bool)
            means.append(_means(points[pending], cell, counts)[is_leaf])
            weights.append(counts[is_leaf].astype(float))
            deviations.append(np.full(int(is_leaf.sum()), 0.5 * self.leaf * 2**level))
            pending = pending[~is_leaf[cell]]
            if not len(pending):
                break
        variances = np.concatenate(deviations) ** 2
        self.crop.check_downsampled(len(variances), frame, "leaf", self.leaf)
        return Observation(
            np.concatenate(means),
            np.concatenate(weights),
            variances,
            frame.camera,
            frame.depth,
            landmarks=frame.landmarks,
        )


def _dense(cells: Indices) -> NDArray[np.bool_]:
    """Returns whether each point (N,) is where the cloud is dense, from its cell (N, 3)."""
    occupied, owner, counts = np.unique(cells, axis=0, return_inverse=True, return_counts=True)
    return np.asarray(dense_voxels(occupied.astype(float), counts)[owner.ravel()])


def _means(points: Array, cell: Indices, counts: Indices) -> Array:
    sums = [np.bincount(cell, weights=column, minlength=len(counts)) for column in points.T]
    return np.asarray(np.column_stack(sums) / counts[:, None])
