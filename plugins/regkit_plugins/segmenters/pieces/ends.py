"""Ends of pieces: a body that hangs on a larger one, such as a hand on a person."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from regkit_plugins.segmenters.pieces.figure import Figure
from regkit_plugins.segmenters.pieces.piece import Piece

NEAREST = 0.005
"""Share of a piece's points that may be stray ones before it."""

REACHES = 10
"""Number of lengths of the end that are tried, from the body alone to the body with all parts."""


def nearest_end(piece: Piece, figure: Figure) -> Piece | None:
    """Returns the end of a piece that is held towards the camera, as far as it is like a body.

    Only a body whose further parts continue in something else hangs on a larger piece; None for
    others, for a piece that is no larger than the body, and for a cloud.

    Args:
        piece: The piece.
        figure: The body.
    """
    longer = figure.extended
    if longer is None or piece.frame.camera is None or piece.area <= figure.largest:
        return None
    points = piece.frame.points[piece.at]
    first = points[np.argsort(points[:, 2])[int(NEAREST * len(points))]]
    away = np.linalg.norm(points - first, axis=1)
    reaches = np.linspace(figure.length, longer.length, REACHES)
    return min((replace(piece, at=piece.at[away < one]) for one in reaches), key=figure.cost)
