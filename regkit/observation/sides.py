"""Left and right of keypoints: a detector that exchanges them in some frames is corrected."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from regkit.observation.keypoints import Keypoints
from regkit.system.arrays import Array, Indices

EXCHANGED = 0.05
"""Cost of an exchanged frame, against the mean jump of the keypoints from frame to frame in units
of the usual distance of left and right, at most one."""


def with_consistent_sides(keypoints: Keypoints) -> tuple[Keypoints, int]:
    """Returns keypoints whose left and right names follow the same side through all frames.

    Detectors exchange the whole sets of left and right keypoints in some frames. Each frame is
    either as given or exchanged; the sequence of least total jump, with ``EXCHANGED`` for each
    exchanged frame, is found by dynamic programming (Viterbi, 1967). So the side of most frames is
    taken for the right one.

    Args:
        keypoints: The keypoints; the names of pairs begin with ``left_`` and ``right_``.

    Returns:
        The keypoints, and the number of frames that were exchanged.
    """
    order = _exchanged_order(keypoints.names)
    places = keypoints.positions
    if not np.isfinite(places).any():
        places = keypoints.pixels
    paired = order != np.arange(len(order))
    sure = np.where(keypoints.confidences[:, :, None] > 0.0, places, np.nan)[:, paired]
    if not paired.any() or len(places) < 2 or not np.isfinite(sure).any():
        return keypoints, 0
    among = np.searchsorted(np.flatnonzero(paired), order[paired])
    exchanged = _exchanged_frames(sure, among)
    return _exchange(keypoints, exchanged, order), int(exchanged.sum())


def _exchanged_order(names: tuple[str, ...]) -> Indices:
    """Returns the column of each keypoint's partner, (L,); its own if it has none."""
    columns = {name: column for column, name in enumerate(names)}
    partners = []
    for column, name in enumerate(names):
        side, _, rest = name.partition("_")
        other = {"left": "right", "right": "left"}.get(side, side)
        partners.append(columns.get(f"{other}_{rest}", column))
    return np.array(partners, dtype=np.intp)


def _exchanged_frames(places: Array, partners: Indices) -> NDArray[np.bool_]:
    """Returns which frames are exchanged, (F,), from places (F, L, D) and partners (L,)."""
    apart = np.linalg.norm(places - places[:, partners], axis=2)
    unit = float(np.nanmedian(apart)) or 1.0
    same = _jumps(places[:-1], places[1:], unit)
    other = _jumps(places[:-1], places[1:, partners], unit)
    cost, back = np.array([0.0, EXCHANGED]), np.zeros((len(places), 2), dtype=np.intp)
    for step in range(len(same)):
        stay, change = same[step], other[step]
        ways = cost[:, None] + np.array([[stay, change], [change, stay]]) + [0.0, EXCHANGED]
        back[step + 1] = ways.argmin(axis=0)
        cost = ways.min(axis=0)
    exchanged = np.zeros(len(places), dtype=bool)
    state = int(cost.argmin())
    for step in range(len(places) - 1, -1, -1):
        exchanged[step], state = bool(state), int(back[step, state])
    return exchanged


def _jumps(before: Array, after: Array, unit: float) -> Array:
    """Returns the mean of the jumps (F - 1,) in units, each at most one; zero if none is known."""
    lengths = np.minimum(np.linalg.norm(after - before, axis=2) / unit, 1.0)
    known = np.isfinite(lengths)
    total = np.where(known, lengths, 0.0).sum(axis=1)
    return np.asarray(total / np.maximum(known.sum(axis=1), 1))


def _exchange(keypoints: Keypoints, frames: NDArray[np.bool_], order: Indices) -> Keypoints:
    arrays = {}
    for name in ("positions", "pixels", "confidences"):
        values = getattr(keypoints, name).copy()
        values[frames] = values[frames][:, order]
        arrays[name] = values
    return replace(keypoints, **arrays)
