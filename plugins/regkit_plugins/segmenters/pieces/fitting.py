"""The piece that is most like a body."""

from __future__ import annotations

from collections.abc import Sequence

from regkit_plugins.segmenters.pieces.ends import nearest_end
from regkit_plugins.segmenters.pieces.figure import LEAST_FIT, Figure
from regkit_plugins.segmenters.pieces.growth import grown
from regkit_plugins.segmenters.pieces.piece import Piece

LIKELY = 4
"""Number of pieces, those most like the body, that are compared with all that belongs to them."""

DISTINCT = 4.0
"""Only if no piece has a smaller cost, two deviations in all, the body may be the end of one.

Chosen on 19 frames of a hand before an SR305, of which two need it.
"""

ALIKE = 1.0
"""Pieces whose costs differ by less, one deviation, fit alike: of them the nearest is chosen."""


def fitting(found: Sequence[Piece], pieces: Sequence[Piece], figure: Figure) -> Piece | None:
    """Returns the piece, or the end of one, that is most like a body; None if none is.

    Args:
        found: The pieces that are large enough.
        pieces: All pieces of the frame, which may belong to one of these.
        figure: The body.
    """
    likely = sorted(found, key=figure.cost)[:LIKELY]
    wholes = [grown(one, pieces, figure) for one in likely]
    if all(cost > DISTINCT for _, cost in wholes):
        ends = [end for one in found if (end := nearest_end(one, figure)) is not None]
        wholes += [(end, figure.cost(end)) for end in ends]
    fits = [(piece, cost) for piece, cost in wholes if cost < LEAST_FIT]
    least = min((cost for _, cost in fits), default=0.0)
    alike = [piece for piece, cost in fits if cost <= least + ALIKE]
    return min(alike, key=lambda piece: piece.depth, default=None)
