"""A canvas on which solids hide one another: colour and depth of each pixel."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from regkit.system.arrays import Array, Indices, Singles
from regkit.viewer.animation.view import FINER, Sheet

PAPER = (251, 251, 253)
"""Colour of the background."""


@dataclass(frozen=True)
class Canvas:
    """A picture that is drawn finer than it is shown.

    Attributes:
        colours: Colours, (H, W, 3) from 0 to 255.
        solids: Colours of the solids, (H, W, 3).
        depths: Depth of the nearest solid in each pixel, (H, W) [m]; infinite beside them.
    """

    colours: Singles
    solids: Singles
    depths: Singles

    @classmethod
    def blank(cls, sheet: Sheet) -> Self:
        """Returns an empty canvas."""
        shape = (FINER * sheet.height, FINER * sheet.width)
        paper = np.tile(np.array(PAPER, dtype=np.float32), (*shape, 1))
        solids = np.zeros((*shape, 3), np.float32)
        return cls(paper, solids, np.full(shape, np.inf, np.float32))

    def add(self, pixels: Indices, depths: Array, colours: Array) -> None:
        """Draws pixels (N, 2), each once, where they are nearer than what is there."""
        columns, rows = pixels.T
        nearer = depths < self.depths[rows, columns]
        rows, columns = rows[nearer], columns[nearer]
        self.depths[rows, columns] = depths[nearer]
        self.solids[rows, columns] = colours[nearer]

    def blend_solids(self, opacity: float) -> None:
        """Blends the solids into the colours."""
        seen = np.isfinite(self.depths)
        self.colours[seen] += np.float32(opacity) * (self.solids[seen] - self.colours[seen])

    def inside(self, pixels: Array, margin: int = 0) -> Array:
        """Returns whether pixels (N, 2) are on the canvas, ``margin`` from its border, (N,)."""
        size = np.array(self.depths.shape[::-1])
        return np.asarray(((pixels >= margin) & (pixels < size - margin)).all(axis=1))
