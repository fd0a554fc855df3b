"""Time of one evaluation of the correlation kernel, relative to its exponentials.

    python benchmarks/kernel.py

13 anisotropic Gaussians (the human G-SoG) and 2,000 isotropic ones (points on its surface): value
and gradient, relative to ``numpy.exp`` of as many numbers in the same run, on one thread.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable

import numpy as np

from regkit.observation import Observation
from regkit.system.optional import one_blas_thread
from regkit_plugins.kernels.correlation import Correlation
from regkit_plugins.shapes.gsog import GeneralizedSumOfGaussians
from regkit_plugins.templates.human import Human

POINTS = 2000
REPEATS, ROUNDS = 200, 25


def microseconds(function: Callable[[], object]) -> float:
    """Returns the lowest mean time of a call over several rounds, to exclude interference."""
    rounds = []
    for _ in range(ROUNDS):
        begun = time.perf_counter()
        for _ in range(REPEATS):
            function()
        rounds.append((time.perf_counter() - begun) / REPEATS)
    return 1e6 * min(rounds)


def main() -> None:
    """Prints the table, and its figures as one JSON object in the last line."""
    random = np.random.default_rng(0)
    body = Human(height=1.75).body(1.75)
    primitives = GeneralizedSumOfGaussians().bind(body)
    placed = primitives.place(body.place(body.skeleton.rest()).transforms)
    chosen = random.integers(len(placed.centres), size=POINTS)
    directions = random.normal(size=(POINTS, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    offsets = 2.0 * primitives.scales[chosen] * directions
    points = placed.centres[chosen] + (placed.axes[chosen] @ offsets[:, :, None])[:, :, 0]
    data = Observation(points, np.ones(POINTS), np.full(POINTS, 0.02**2))
    exact = Correlation(covariance="exact").bind(data, placed)
    frozen = Correlation(covariance="frozen").bind(data, placed)
    exponents = -random.uniform(0.0, 50.0, size=(len(primitives), POINTS))

    with one_blas_thread():
        exp = microseconds(lambda: np.exp(exponents))
        rows = {
            "numpy.exp": exp,
            "exact covariance": microseconds(lambda: exact(placed)),
            "frozen covariance": microseconds(lambda: frozen(placed)),
        }
    print(f"{len(primitives)} x {POINTS} pairs, one thread")
    for name, cost in rows.items():
        print(f"  {name:20s} {cost:8.1f} us   {cost / exp:5.2f} x exp")
    ratios = {name: round(cost / exp, 3) for name, cost in rows.items()}
    print(json.dumps({"pairs": exponents.size, "threads": 1, "ratio_to_exp": ratios}))


if __name__ == "__main__":
    main()
