"""Verdicts of the frames of a track, of the whole and of each of several bodies."""

from __future__ import annotations

from collections.abc import Mapping

from regkit.body.each import verdicts_of_each
from regkit.body.verdict import Verdict, frame_verdicts, worst
from regkit.system.arrays import Array

SHARES = ("inlier_shares", "coverages", "misfits", "reliefs")
"""Arrays of a track, (T,), that judge a frame."""


def verdicts_of(rows: Mapping[str, Array]) -> tuple[Verdict, ...]:
    """Returns the verdict of each frame, (T,); of several bodies, the worst.

    Args:
        rows: The arrays of a track by name: ``points``, the ``SHARES``, and ``body_shares`` of
            several bodies.
    """
    whole = frame_verdicts(rows["points"], *(rows[name] for name in SHARES))
    if "body_shares" not in rows:
        return whole
    each = body_verdicts(rows["points"], rows["body_shares"])
    return tuple(worst((one, *bodies)) for one, bodies in zip(whole, each, strict=True))


def body_verdicts(points: Array, shares: Array) -> tuple[tuple[Verdict, ...], ...]:
    """Returns the verdicts of K bodies in each of T frames.

    Args:
        points: Number of points, (T,).
        shares: What ``shares_of_each`` returns, (T, K, 4).
    """
    none = (Verdict.NO_DATA,) * shares.shape[1]
    return tuple(
        verdicts_of_each(row) if count else none
        for count, row in zip(points.tolist(), shares, strict=True)
    )
