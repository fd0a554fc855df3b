"""Compiled functions with fixed types: how they are called by name and by address."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest

from regkit.interfaces import Kernel, Prior
from regkit.observation import Observation
from regkit.registration import Plan, PlannedEnergy
from regkit.system.arrays import Array
from regkit.system.calls import Pointer
from regkit.system.compiled import compiled
from regkit.system.errors import PluginError
from regkit.system.machine_types import Matrix, Vector, machine_signature
from regkit_plugins.kernels.likelihood import Likelihood
from regkit_plugins.shapes.gsog import GeneralizedSumOfGaussians
from regkit_plugins.templates.hand import Hand


class Pair(NamedTuple):
    rows: Matrix
    factor: float


@compiled(python=False)
def scaled(pair: Pair, row: int) -> Vector:
    out = np.empty(pair.rows.shape[1])
    for i in range(len(out)):
        out[i] = pair.factor * pair.rows[row, i]
    return out


@compiled
def total(pair: Pair) -> float:
    result = 0.0
    for row in range(len(pair.rows)):
        for value in scaled(pair, row):
            result += value
    return result


@compiled(python=False)
def refused(pair: Pair, row: int) -> Vector:
    if row > 0:
        raise ValueError("no such row")
    return pair.rows[0].copy()


@compiled
def first_of_refused(pair: Pair, row: int) -> float:
    return float(refused(pair, row)[0])


PROTOTYPE = Pointer(scaled.function)


@compiled
def through_pointer(address: int, pair: Pair) -> float:
    return float(PROTOTYPE(address, pair, 1)[0])


@compiled
def inferred(values: Array) -> float:
    return float(values[0])


PAIR = Pair(np.array([[1.0, 2.0], [3.0, 4.0]]), 10.0)


def test_function_calls_another_by_name():
    assert total(PAIR) == 100.0


def test_function_is_called_by_address():
    assert through_pointer(scaled.address, PAIR) == 30.0


def test_error_of_a_callee_reaches_python():
    assert first_of_refused(PAIR, 0) == 1.0
    with pytest.raises(ValueError, match="no such row"):
        first_of_refused(PAIR, 1)


def test_annotations_fix_the_types_or_not():
    assert machine_signature(total.function) is not None
    assert machine_signature(inferred.function) is None
    assert inferred(np.array([1.0])) == inferred(np.array([[1.0]]).T[0]) == 1.0
    with pytest.raises(PluginError, match="inferred needs annotations"):
        _ = inferred.address


def test_pointer_accepts_the_types_of_its_prototype_only():
    assert PROTOTYPE.accepts(refused.function)
    assert not PROTOTYPE.accepts(total.function)


def test_part_with_other_annotations_is_refused_by_name():
    class Odd(Likelihood):
        def compiled(self, primitives):
            return replace(super().compiled(primitives), respond=total)

    body = Hand(length=0.19).body(0.19)
    primitives = GeneralizedSumOfGaussians().bind(body)
    plan = Plan.of(body, primitives, Odd(), ())
    assert plan is not None
    with pytest.raises(PluginError, match=r"total must have the annotations of .*respond"):
        _ = plan.arrays


def test_kernel_without_inlier_probabilities_has_unknown_ones():
    class Silent(Likelihood):
        def compiled(self, primitives):
            return replace(super().compiled(primitives), explain=None)

    body = Hand(length=0.19).body(0.19)
    plan = Plan.of(body, GeneralizedSumOfGaussians().bind(body), Silent(), ())
    points = np.random.default_rng(0).normal(size=(50, 3)) + np.array([0.0, 0.0, 2.0])
    data = Observation(points, np.ones(50), np.full(50, 1e-4))
    pose = body.skeleton.rest()
    energy, _ = PlannedEnergy.of(plan, data, [pose], Prior(pose))
    assert np.isnan(energy.inlier_probability(pose)).all()


def test_subclass_that_overrides_the_readable_form_alone_runs_it():
    class Changed(Likelihood):
        def bind(self, observation, start, *, smoothing=0.0):
            return super().bind(observation, start, smoothing=smoothing)

    class Renamed(Likelihood):
        pass

    body = Hand(length=0.19).body(0.19)
    primitives = GeneralizedSumOfGaussians().bind(body)
    assert Plan.of(body, primitives, Changed(), ()) is None
    assert Plan.of(body, primitives, Renamed(), ()) is not None
    assert Kernel.compiled(Changed(), primitives) is None


def test_machine_code_is_not_that_of_another_callee():
    # Numba itself looks at the file of a function alone, and not at those of its callees.
    def defined(text):
        names = {"compiled": compiled, "__name__": "odd"}
        exec(text, names)
        return names["outer"]

    outer = "@compiled\ndef outer(x: float) -> float:\n    return inner(x)\n"
    inner = "@compiled\ndef inner(x: float) -> float:\n    return {} * x\n"
    one, same, other = (defined(inner.format(n) + outer) for n in ("x", "x", "x * x"))
    assert one.digest == same.digest
    assert one.digest != other.digest
