"""What part of a frame is looked at."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from regkit.config.model import Model
from regkit.observation import Frame
from regkit.system.arrays import Array, Indices, checked_points
from regkit.system.errors import DataError

Distance = Annotated[float, Field(gt=0.0)]

LEAST = 4
"""Fewer points than this after downsampling tell that the cubes are larger than the body."""


class Crop(Model):
    """Keeps the points of the object and drops what lies before and behind it."""

    near: Distance | None = None
    """Drop what is nearer to the camera than this, along its axis [m]."""
    far: Distance | None = None
    """Drop what is farther away than this [m]."""
    behind_nearest: Distance | None = None
    """Keep only what is at most so far behind the nearest points [m]: a hand before its owner."""
    connected: Annotated[float, Field(ge=1e-3)] | None = None
    """Keep only the piece nearest to the camera, pieces being at least so far apart [m]."""
    min_points: Annotated[int, Field(ge=1)] = 20
    """Fewer points than this are an error: no pose can be told from them."""

    @model_validator(mode="after")
    def _in_order(self) -> Crop:
        if self.near is not None and self.far is not None and self.near >= self.far:
            raise ValueError(f"near ({self.near} m) must be less than far ({self.far} m)")
        return self

    def cropped(self, frame: Frame) -> Frame:
        """The frame with what is kept of its points, and of its depth image if it has one.

        Raises:
            DataError: If a coordinate is not finite or fewer than ``min_points`` are left.
        """
        points = checked_points(frame.points, place=frame.place)
        if not len(points):
            raise DataError("the frame is empty: it has no measured point", place=frame.place)
        kept = self._kept(points)
        if len(kept) < self.min_points:
            raise DataError(
                f"{len(kept)} of the frame's {len(points)} points are left after cropping; at "
                f"least {self.min_points} are needed (preprocessor.crop)",
                place=frame.place,
            )
        if len(kept) == len(points):
            return frame
        depth = frame.depth
        if depth is not None and np.count_nonzero(depth > 0.0) == len(points):
            # Points come row by row from the measured pixels; what is cut away was seen through.
            pixels = np.flatnonzero(depth > 0.0)[kept]
            depth = np.zeros_like(depth)
            depth.flat[pixels] = points[kept, 2]
        return replace(frame, points=points[kept], depth=depth)

    def check_thinned(self, left: int, frame: Frame, field: str, side: float) -> None:
        """Refuse cubes so large that hardly a point is left, as of millimetres given for metres.

        Args:
            left: How many points there are after downsampling.
            frame: What was downsampled.
            field: The preprocessor's field that says how large the cubes are.
            side: Its value [m].

        Raises:
            DataError: If fewer than ``LEAST`` are left, or ``min_points`` where that is less.
        """
        least = min(LEAST, self.min_points)
        if left < least:
            raise DataError(
                f"{side:g} m is too large: the frame's {len(frame.points)} points become {left}; "
                f"at least {least} are needed (preprocessor.{field}, in metres)",
                place=frame.place,
            )

    def _kept(self, points: Array) -> Indices:
        """Which of the points (N, 3) are kept, in their order."""
        depths = points[:, 2]
        kept = np.arange(len(points))
        if self.near is not None:
            kept = kept[depths[kept] >= self.near]
        if self.far is not None:
            kept = kept[depths[kept] <= self.far]
        if self.behind_nearest is not None and len(kept):
            # A percentile rather than the minimum, which a single stray pixel would set.
            nearest = float(np.percentile(depths[kept], 0.5))
            kept = kept[depths[kept] <= nearest + self.behind_nearest]
        if self.connected is not None and len(kept):
            kept = kept[_nearest_piece(points[kept], self.connected)]
        return kept


def _nearest_piece(points: Array, gap: float) -> NDArray[np.bool_]:
    """Which points are of the piece nearest to the camera, (N,).

    No occupied cubes of the side ``gap`` [m] join the others to it.
    """
    from scipy.ndimage import label

    cells = np.floor(points / gap).astype(np.int64)
    cells -= cells.min(axis=0)
    occupied = np.zeros(cells.max(axis=0) + 1, dtype=bool)
    occupied[tuple(cells.T)] = True
    pieces, _ = label(occupied, structure=np.ones((3, 3, 3)))
    piece = pieces[tuple(cells.T)]
    # Most of the nearest points decide, for a single one may be a stray pixel.
    nearest = points[:, 2] <= np.percentile(points[:, 2], 2.0)
    return np.asarray(piece == np.bincount(piece[nearest]).argmax())
