"""What part of a frame is looked at."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field, model_validator

from regkit.arrays import Array, checked_points
from regkit.errors import DataError
from regkit.model import Model
from regkit.observation import Frame

Distance = Annotated[float, Field(gt=0.0)]


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

    def points(self, frame: Frame) -> Array:
        """The points (N, 3) [m] of a frame that are kept.

        Raises:
            DataError: If a coordinate is not finite or fewer than ``min_points`` are left.
        """
        points = checked_points(frame.points, place=frame.place)
        if not len(points):
            raise DataError("the frame is empty: it has no measured point", place=frame.place)
        kept = points
        if self.near is not None:
            kept = kept[kept[:, 2] >= self.near]
        if self.far is not None:
            kept = kept[kept[:, 2] <= self.far]
        if self.behind_nearest is not None and len(kept):
            # A percentile rather than the minimum, which a single stray pixel would set.
            nearest = float(np.percentile(kept[:, 2], 0.5))
            kept = kept[kept[:, 2] <= nearest + self.behind_nearest]
        if self.connected is not None and len(kept):
            kept = _nearest_piece(kept, self.connected)
        if len(kept) < self.min_points:
            raise DataError(
                f"{len(kept)} of the frame's {len(points)} points are left after cropping; at "
                f"least {self.min_points} are needed (observer.crop)",
                place=frame.place,
            )
        return kept


def _nearest_piece(points: Array, gap: float) -> Array:
    """The piece nearest to the camera, of those that no occupied cubes of side ``gap`` [m] join."""
    from scipy.ndimage import label

    cells = np.floor(points / gap).astype(np.int64)
    cells -= cells.min(axis=0)
    occupied = np.zeros(cells.max(axis=0) + 1, dtype=bool)
    occupied[tuple(cells.T)] = True
    pieces, _ = label(occupied, structure=np.ones((3, 3, 3)))
    piece = pieces[tuple(cells.T)]
    # Most of the nearest points decide, for a single one may be a stray pixel.
    nearest = points[:, 2] <= np.percentile(points[:, 2], 2.0)
    return np.asarray(points[piece == np.bincount(piece[nearest]).argmax()])
