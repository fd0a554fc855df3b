"""Time of one evaluation of a kernel of Gaussians, relative to its exponentials.

    python benchmarks/kernel.py

13 anisotropic Gaussians (the human G-SoG) and 2,000 isotropic ones (points on its surface): value,
wrenches and Gauss-Newton blocks, compiled and in the readable form, relative to ``numpy.exp`` of as
many numbers in double precision in the same run, on one thread.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable

import numpy as np

from regkit.body import Body
from regkit.interfaces import Kernel, Prior
from regkit.interfaces.compiled import RESPOND, SceneArrays
from regkit.observation import Observation
from regkit.primitives import Placed, Primitives
from regkit.registration import Plan, PlannedEnergy
from regkit.skeleton import Pose
from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, Stack, Vector
from regkit.system.optional import one_blas_thread
from regkit_plugins.kernels.correlation import Correlation
from regkit_plugins.kernels.likelihood import Likelihood
from regkit_plugins.shapes.gsog import GeneralizedSumOfGaussians
from regkit_plugins.templates.human import Human

POINTS = 2000
REPEATS, ROUNDS = 100, 25


@compiled
def responses(
    times: int,
    address: int,
    scene: SceneArrays,
    centres: Matrix,
    axes: Stack,
    numbers: Vector,
    table: Matrix,
    state: Matrix,
    wrenches: Matrix,
    stiffness: Stack,
) -> float:
    """Returns a compiled kernel's energy; evaluates it several times, as a compiled solver does."""
    energy = 0.0
    for _ in range(times):
        energy = RESPOND(
            address, scene, centres, axes, numbers, table, state, 2, wrenches, stiffness
        )
    return energy


class CompiledKernel:
    """A kernel by compiled functions, bound to data."""

    def __init__(self, kernel: Kernel, body: Body, data: Observation, pose: Pose) -> None:
        primitives = GeneralizedSumOfGaussians().bind(body)
        plan = Plan.of(body, primitives, kernel, ())
        assert plan is not None
        found = PlannedEnergy.of(plan, data, [pose], Prior(pose))
        assert found is not None
        bound, _ = found
        self.scene, self.state, self.plan = bound.scene, bound.states, plan.arrays
        count = len(primitives)
        self.wrenches, self.stiffness = np.zeros((count, 6)), np.zeros((count, 6, 6))

    def __call__(self, times: int = REPEATS) -> float:
        """Evaluates it several times."""
        scene, plan = self.scene, self.plan
        return responses(
            times,
            int(plan.functions[0, 1]),
            scene,
            scene.centres,
            scene.axes,
            plan.numbers[0],
            plan.table,
            self.state,
            self.wrenches,
            self.stiffness,
        )


def microseconds(function: Callable[[], object], repeats: int = REPEATS) -> float:
    """Returns the lowest mean time of a call over several rounds, to exclude interference."""
    rounds = []
    for _ in range(ROUNDS):
        begun = time.perf_counter()
        for _ in range(repeats):
            function()
        rounds.append((time.perf_counter() - begun) / repeats)
    return 1e6 * min(rounds)


def data_on(placed: Placed[Primitives], random: np.random.Generator) -> Observation:
    """Returns points on the surface of placed Gaussians."""
    scales = placed.primitives.scales
    chosen = random.integers(len(placed.centres), size=POINTS)
    directions = random.normal(size=(POINTS, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    offsets = 2.0 * scales[chosen] * directions
    points = placed.centres[chosen] + (placed.axes[chosen] @ offsets[:, :, None])[:, :, 0]
    return Observation(points, np.ones(POINTS), np.full(POINTS, 0.02**2))


def main() -> None:
    """Prints the table, and its figures as one JSON object in the last line."""
    random = np.random.default_rng(0)
    body = Human(height=1.75).body(1.75)
    primitives, pose = GeneralizedSumOfGaussians().bind(body), body.skeleton.rest()
    placed = primitives.place(body.place(pose).transforms)
    data = data_on(placed, random)
    exponents = -random.uniform(0.0, 50.0, size=(len(primitives), POINTS))
    single = exponents.astype(np.float32)
    kernels = {
        "exact covariance": Correlation(covariance="exact"),
        "frozen covariance": Correlation(covariance="frozen"),
        "likelihood": Likelihood(),
    }
    rows, errors = {}, {}
    with one_blas_thread():
        rows["numpy.exp"] = exp = microseconds(lambda: np.exp(exponents))
        rows["numpy.exp, single precision"] = microseconds(lambda: np.exp(single))
        for name, kernel in kernels.items():
            fast, plain = CompiledKernel(kernel, body, data, pose), kernel.bind(data, placed)
            rows[name] = microseconds(fast, repeats=1) / REPEATS
            rows[f"{name}, readable"] = microseconds(lambda one=plain: one(placed, curvature=True))
            fast.wrenches[:] = 0.0
            energy, expected = fast(1), plain(placed)
            size = np.abs(expected.wrenches).max()
            errors[name] = {
                "energy": abs(energy / expected.energy - 1.0),
                "wrenches": float(np.abs(fast.wrenches - expected.wrenches).max() / size),
            }
    print(f"{len(primitives)} x {POINTS} pairs, value, wrenches and blocks, one thread")
    for name, cost in rows.items():
        error = errors.get(name)
        told = f"   error {error['energy']:.1e}, {error['wrenches']:.1e}" if error else ""
        print(f"  {name:28s} {cost:8.1f} us   {cost / exp:5.2f} x exp{told}")
    ratios = {name: round(cost / exp, 3) for name, cost in rows.items()}
    single_ratio = round(rows["exact covariance"] / rows["numpy.exp, single precision"], 3)
    figures = {
        "pairs": exponents.size,
        "threads": 1,
        "ratio_to_exp": ratios,
        "exact_covariance_to_single_exp": single_ratio,
        "relative_errors": errors,
    }
    print(json.dumps(figures))


if __name__ == "__main__":
    main()
