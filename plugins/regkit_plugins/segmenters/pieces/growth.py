"""Pieces of one body that something before them cuts apart."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import scipy

from regkit_plugins.segmenters.pieces.figure import Figure
from regkit_plugins.segmenters.pieces.piece import Piece

FAR, BESIDE = 0.35, 0.25
"""Largest distances of two pieces of one body, in sizes of the body: across something that hides
the way, such as a table, and to a part that another part of the body hides."""

LIMBS = 0.02
"""Least area of a piece that is added, as a part of the body's."""

FRAGMENT, CLOSE = 0.15, 0.06
"""Largest area of a fragment, as a part of the body's, and its largest distance, in sizes of the
body."""

FLAT = 0.4
"""A piece of this flatness is no limb."""

STEPS = 20
"""Number of places on the way from one piece to the other that are looked at."""

HIDDEN = 0.4
"""Least share of the way that is hidden."""

TOUCHING = 2
"""Largest distance of pieces that are beside each other in the image [px]."""

GRACE = 0.5
"""A piece behind something that hides the way may raise the cost by this much: the body may be
larger than usual."""


def grown(seed: Piece, pieces: Sequence[Piece], figure: Figure) -> tuple[Piece, float]:
    """Returns a piece with those that belong to it, and the cost of all.

    A piece is added if something nearer hides the way to it, or if it is beside in the image and
    both together are more like the body.

    Args:
        seed: The piece.
        pieces: All pieces of the frame, the seed among them.
        figure: The body.
    """
    cost = figure.cost(seed)
    rest = [piece for piece in pieces if piece is not seed]
    grows = True
    while grows:
        grows = False
        for piece in rest:
            if piece.area < LIMBS * figure.area:
                continue
            grace = _grace(seed, piece, figure)
            if grace is None:
                continue
            both = seed.with_piece(piece)
            larger = figure.cost(both)
            if larger < cost + grace:
                seed, cost, grows = both, larger, True
                rest = [other for other in rest if other is not piece]
                break
    return with_fragments(seed, rest, figure), cost


def with_fragments(body: Piece, others: Sequence[Piece], figure: Figure) -> Piece:
    """Returns a body with the others that are as small as a part of a limb and close to it.

    Noise cuts off hands, which a tracker that lost them does not expect there.
    """
    small = [piece for piece in others if piece.area <= FRAGMENT * figure.area]
    tree, close = scipy.spatial.KDTree(body.sample), CLOSE * figure.size
    near = [piece.at for piece in small if np.min(tree.query(piece.sample)[0]) <= close]
    return replace(body, at=np.sort(np.concatenate([body.at, *near])))


def _grace(first: Piece, second: Piece, figure: Figure) -> float | None:
    """Returns by how much a second piece may raise the cost; None if it is not near the first."""
    frame = first.frame
    if frame.camera is None or frame.depth is None or frame.pixels is None:
        return None
    distances, nearest = map(np.asarray, scipy.spatial.KDTree(first.sample).query(second.sample))
    at = int(distances.argmin())
    if distances[at] > FAR * figure.size:
        return None
    start, end = first.sample[nearest[at]], second.sample[at]
    along = ((np.arange(STEPS) + 0.5) / STEPS)[:, None]
    way = start + along * (end - start)
    columns, rows = np.rint(frame.camera.projected(way)).astype(np.intp).T
    height, width = frame.depth.shape
    inside = (rows >= 0) & (rows < height) & (columns >= 0) & (columns < width)
    seen = frame.depth[rows[inside], columns[inside]]
    before = (seen > 0.0) & (seen < way[inside, 2] - first.gap)
    if (before | np.isnan(seen)).sum() >= HIDDEN * STEPS:
        return GRACE
    beside = distances[at] <= BESIDE * figure.size and _touch(first, second)
    # Unlike a limb before or behind the trunk, furniture is flat.
    return 0.0 if beside and figure.flatness(second) < FLAT else None


def _touch(first: Piece, second: Piece) -> bool:
    """Returns whether two pieces are beside each other in the image."""
    around = scipy.ndimage.binary_dilation(first.mask, iterations=TOUCHING)
    return bool((around & second.mask).any())
