"""Instants of several cameras: frames of about the same time belong together."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from regkit.system.arrays import Array, Indices


def matched(times: Sequence[Array], tolerance: float) -> Indices:
    """Returns the frame of each camera in each instant, (N, V); -1 for a camera without one.

    In the order of time, each frame joins the instant before it if that is no older than the
    tolerance and has none of its camera yet; otherwise a new instant begins. At a tolerance of half
    a period, each frame of the fastest camera thus gets the nearest one of every other.

    Args:
        times: Times of each camera's frames, ascending, (T_v,) [s].
        tolerance: Largest difference of the times of an instant [s].
    """
    cameras = np.concatenate([np.full(len(own), view) for view, own in enumerate(times)])
    frames = np.concatenate([np.arange(len(own)) for own in times])
    every = np.concatenate(list(times))
    instants: list[list[int]] = []
    begun = -np.inf
    # Cameras at the same time come in their order, which is that of the file.
    for at in np.lexsort((frames, cameras, every)):
        view = int(cameras[at])
        late = every[at] - begun > tolerance * (1.0 + 1e-9)
        if late or instants[-1][view] >= 0:
            instants.append([-1] * len(times))
            begun = float(every[at])
        instants[-1][view] = int(frames[at])
    return np.array(instants, dtype=np.intp).reshape(-1, len(times))


def runs(indices: Indices) -> list[tuple[int, int]]:
    """Returns the first and last of each run of consecutive ascending numbers (N,)."""
    if not len(indices):
        return []
    breaks = np.flatnonzero(np.diff(indices) > 1)
    firsts, lasts = np.r_[0, breaks + 1], np.r_[breaks, len(indices) - 1]
    return [(int(indices[a]), int(indices[b])) for a, b in zip(firsts, lasts, strict=True)]
