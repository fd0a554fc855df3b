"""Cropping: segmentation of the object in a frame by depth and connectivity."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from regkit.config.model import Model
from regkit.config.quantities import Length
from regkit.observation import Frame
from regkit.system.arrays import Array, Indices, checked_points
from regkit.system.errors import DataError, NoDataError

MIN_DOWNSAMPLED = 4
"""Fewer points than this after downsampling mean that the voxels are larger than the body."""


class Crop(Model):
    """Keeps the points of the object and removes the foreground and background."""

    near: Length | None = None
    """Minimum depth [m]; nearer points are removed."""
    far: Length | None = None
    """Maximum depth [m]; farther points are removed."""
    behind_nearest: Length | None = None
    """Maximum depth behind the nearest points [m], for example to separate a hand from its
    person."""
    connected: Annotated[float, Field(ge=1e-3, le=1e3)] | None = None
    """Keep only the connected component nearest to the camera; components are separated by at
    least this distance [m]."""
    min_points: Annotated[int, Field(ge=1, le=100_000_000)] = 20
    """Minimum number of points after cropping; fewer are an error."""

    @model_validator(mode="after")
    def _in_order(self) -> Crop:
        if self.near is not None and self.far is not None and self.near >= self.far:
            raise ValueError(f"near ({self.near} m) must be less than far ({self.far} m)")
        return self

    def cropped(self, frame: Frame) -> Frame:
        """Returns the frame with cropped points and, if it has one, cropped depth image.

        Removed pixels are free space, but those nearer than ``near`` are unknown.

        Raises:
            NoDataError: If the frame is empty, or fewer than ``min_points`` points are left.
            DataError: If a coordinate is not finite.
        """
        points = checked_points(frame.points, place=frame.place)
        if not len(points):
            raise NoDataError("the frame is empty: it has no valid point", place=frame.place)
        kept = self._kept(points)
        if len(kept) < self.min_points:
            raise NoDataError(
                f"{len(kept)} of the frame's {len(points)} points are left after cropping; at "
                f"least {self.min_points} are needed (preprocessor.crop)",
                place=frame.place,
            )
        if len(kept) == len(points):
            return frame
        mask = np.zeros(len(points), dtype=bool)
        mask[kept] = True
        # Only what is nearer than ``near`` may hide the object.
        free = None if self.near is None else points[:, 2] >= self.near
        return frame.only(mask, free=np.ones_like(mask) if free is None else free)

    def check_downsampled(self, count: int, frame: Frame, field: str, side: float) -> None:
        """Rejects voxels that leave hardly any point, such as a size in millimetres.

        Args:
            count: Number of points after downsampling.
            frame: The frame that was downsampled.
            field: Name of the preprocessor's field for the voxel size.
            side: Value of that field [m].

        Raises:
            DataError: If fewer than ``MIN_DOWNSAMPLED`` points are left, or ``min_points`` if that
                is smaller.
        """
        least = min(MIN_DOWNSAMPLED, self.min_points)
        if count < least:
            raise DataError(
                f"{side:g} m is too large: the frame's {len(frame.points)} points become {count}; "
                f"at least {least} are needed (preprocessor.{field}, in metres)",
                place=frame.place,
            )

    def _kept(self, points: Array) -> Indices:
        """Returns the indices of the points (N, 3) to keep, ascending."""
        depths = points[:, 2]
        kept = np.arange(len(points))
        if self.near is not None:
            kept = kept[depths[kept] >= self.near]
        if self.far is not None:
            kept = kept[depths[kept] <= self.far]
        if self.behind_nearest is not None and len(kept):
            # A percentile is robust to stray pixels, the minimum is not.
            nearest = float(np.percentile(depths[kept], 0.5))
            kept = kept[depths[kept] <= nearest + self.behind_nearest]
        if self.connected is not None and len(kept):
            kept = kept[_nearest_component(points[kept], self.connected)]
        return kept


def _nearest_component(points: Array, gap: float) -> NDArray[np.bool_]:
    """Returns a mask (N,) of the connected component nearest to the camera.

    Components are sets of adjacent occupied voxels of the size ``gap`` [m].
    """
    from scipy.ndimage import label

    cells = np.floor(points / gap).astype(np.int64)
    cells -= cells.min(axis=0)
    occupied = np.zeros(cells.max(axis=0) + 1, dtype=bool)
    occupied[tuple(cells.T)] = True
    components, _ = label(occupied, structure=np.ones((3, 3, 3)))
    component = components[tuple(cells.T)]
    # The majority of the nearest points decides, because a single one may be a stray pixel.
    nearest = points[:, 2] <= np.percentile(points[:, 2], 2.0)
    return np.asarray(component == np.bincount(component[nearest]).argmax())
