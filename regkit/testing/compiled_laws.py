"""Laws of compiled functions: they compute what the readable form computes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from regkit.body import Body
from regkit.config.plugin import Plugin
from regkit.interfaces import CompiledEnergy, CompiledJoints, CompiledPart, CompiledWeights, Prior
from regkit.interfaces.compiled import SceneArrays
from regkit.observation import Observation
from regkit.primitives import Primitives
from regkit.primitives.arrays import PrimitiveArrays
from regkit.registration import Plan, PlannedEnergy
from regkit.registration.pose_problem import PoseProblem
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, Stack, Vector
from regkit.testing.verdict import require

TOLERANCE = 1e-4
"""Maximum difference relative to the largest entry; single precision has 1e-7."""


@compiled(python=False)
def nothing(
    scene: SceneArrays,
    centres: Matrix,
    axes: Stack,
    numbers: Vector,
    table: Matrix,
    state: Matrix,
    order: int,
    wrenches: Matrix,
    stiffness: Stack,
) -> float:
    """Returns an energy of zero, to test a term alone."""
    return 0.0


def alike(data: Observation) -> Observation:
    """Returns data whose points have the same variance, for which compiled functions are."""
    return replace(data, variances=np.full(len(data.points), data.variances.mean()))


def planned(
    body: Body,
    primitives: Primitives,
    part: CompiledPart | None,
    data: Observation,
    pose: Pose,
    smoothing: float = 0.0,
    prior: Prior | None = None,
) -> PlannedEnergy:
    """Returns a compiled part bound to data at a pose; skips the law if there is none."""
    if part is None or type(primitives).place is not Primitives.place:
        pytest.skip("it has no compiled functions for these primitives")
    kernel = isinstance(part, CompiledEnergy) and part.explain is not None
    parts: tuple[CompiledPart, ...] = (part,) if kernel else (CompiledEnergy(nothing), part)
    plan = Plan(body, PrimitiveArrays.of(primitives), parts)
    bound = PlannedEnergy.of(plan, data, [pose], prior or Prior(pose), smoothing)
    assert bound is not None
    return bound[0]


_NAMES = ("energy", "gradient", "matrix")


def require_same_equations(
    plugin: Plugin, readable: PoseProblem, fast: PoseProblem, x: Array, look_at: object
) -> None:
    """Requires that two problems have the same energy, gradient and matrix at x (m,)."""
    own = fast.normal_equations(x)
    assert own is not None
    expected = readable.normal_equations(x) or (*readable.value_and_gradient(x), own[2])
    for name, value, wanted in zip(_NAMES, own, expected, strict=True):
        require_same(plugin, name, np.asarray(value), np.asarray(wanted), look_at)
    value, slope = fast.value_and_gradient(x)
    require_same(plugin, "energy without curvature", np.asarray(value), np.asarray(own[0]), look_at)
    require_same(plugin, "gradient without curvature", slope, own[1], look_at)


def require_same(plugin: Plugin, name: str, value: Array, wanted: Array, look_at: object) -> None:
    """Requires that two arrays agree to single precision."""
    size = max(float(np.abs(wanted).max()), 1e-3)
    by = float(np.abs(value - wanted).max()) / size
    require(
        by < TOLERANCE, plugin, f"has a compiled {name} that differs from the readable one by "
        f"{by:.2g} of its largest entry", look_at=look_at,
    )  # fmt: skip


def function_of(part: CompiledPart | None) -> object:
    """Returns the Python function of a part, for its author to look at."""
    if isinstance(part, CompiledEnergy | CompiledJoints):
        return part.respond.function
    return part.weigh.function if isinstance(part, CompiledWeights) else None
