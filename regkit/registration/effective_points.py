"""The effective number of independent points, from the correlation of the residuals."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from regkit.observation import Observation
from regkit.registration.compiled_correlation import products_by_distance
from regkit.system.arrays import Array, loop_input

COUNT = 200
"""Largest number of points between which the correlation is estimated."""

BIN = 0.02
"""Width of a bin of distances, as a fraction of the body's size."""

LONGEST = 0.4
"""Longest distance over which residuals count as correlated, as a fraction of the body's size."""


def effective_points(
    points: Array, residuals: Array, shares: Array, size: float, total: int
) -> float:
    """Returns how many independent points would tell as much as these correlated ones.

    The sum of N whitened residuals r of D components has the variance N D if they are independent
    and the model is right. The residuals' own products say what it is: the sum of r_i r_j over all
    pairs, up to the distance where they are no longer alike. With the shares p of the points in the
    model, N_eff = N D sum p / sum r_i r_j. So both count: that neighbours err alike, and that they
    err more than the model expects.

    Args:
        points: The points, (M, 3) [m].
        residuals: Their whitened residuals, (M, D).
        shares: Their shares in the model, (M,), from 0 to 1.
        size: Size of the body [m].
        total: Number N of points of the frame, of which these are some.

    Returns:
        The number, at most N; NaN without any residual.
    """
    count, squares = len(points), float((residuals**2).sum())
    if squares == 0.0:
        return float("nan")
    sums = products_by_distance(loop_input(points), residuals, BIN * size, round(LONGEST / BIN))
    unlike = np.flatnonzero(sums < 0.0)
    correlated = 2.0 * float(sums[: unlike[0] if len(unlike) else len(sums)].sum())
    # The pairs of all points are as many more as there are points more, squared.
    pairs = correlated / max(count * (count - 1), 1) * total * (total - 1)
    variance = squares * total / count + pairs
    parts = residuals.shape[1]
    return float(min(total * parts * total * shares.mean() / variance, total))


def thinned(observation: Observation) -> Observation:
    """Returns at most ``COUNT`` points of an observation, evenly among them."""
    step = -(-len(observation.points) // COUNT)
    if step == 1:
        return observation
    normals = observation.normals
    return replace(
        observation,
        points=observation.points[::step],
        weights=observation.weights[::step],
        variances=observation.variances[::step],
        normals=None if normals is None else normals[::step],
    )
