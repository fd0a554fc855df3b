"""The laws of free parameters catch faults."""

from typing import ClassVar, Literal, Self

import numpy as np
import pytest

from regkit.body import (
    Body,
    EllipsoidParameters,
    Freedom,
    GaussianParameters,
    ShapeParameters,
    ellipsoids,
    gaussians,
)
from regkit.body.freedoms import MIRROR
from regkit.body.vectors import rounded, vector
from regkit.geometry.rotation import vector_to_matrix
from regkit.interfaces import ListedShapeModel, ShapeModel
from regkit.primitives import Gaussians, Primitives
from regkit.system.arrays import Array
from regkit.testing.samples import linkage
from regkit.testing.step_laws import StepLaws


class Faultless(ListedShapeModel):
    """Gaussians that a template lists."""

    kind: Literal["faultless"] = "faultless"
    makes: ClassVar[type[Primitives]] = Gaussians
    parameters: ClassVar[type[ShapeParameters] | None] = EllipsoidParameters

    def bind(self, body: Body) -> Gaussians:
        listed = self.listed(body)
        assert listed is not None
        return Gaussians(*ellipsoids(listed))


class Weighted(Faultless):
    """Weighted Gaussians that a template lists."""

    parameters: ClassVar[type[ShapeParameters] | None] = GaussianParameters

    def bind(self, body: Body) -> Gaussians:
        listed = self.listed(body)
        assert listed is not None
        return Gaussians(*gaussians(listed))


class Weightless(Weighted):
    """Forgets the weights."""

    bind = Faultless.bind


class Swelling(GaussianParameters):
    """Grows with its weight."""

    def moved(self, step: Array) -> Self:
        moved = super().moved(step)
        size = float(np.exp(step[-1]))
        return moved.model_copy(update={"sigma": vector(size * np.array(moved.sigma))})


class Shifted(EllipsoidParameters):
    """Moves with every step, also with one of zero."""

    def moved(self, step: Array) -> Self:
        return super().moved(step + 1e-3)


class Rounded(EllipsoidParameters):
    """Moves by tenths of a millimetre."""

    def moved(self, step: Array) -> Self:
        moved = super().moved(step)
        return moved.model_copy(update={"centre": rounded(np.array(moved.centre))})


class Spun(EllipsoidParameters):
    """Rotates in its own axes, not in the segment's frame."""

    def moved(self, step: Array) -> Self:
        axes = vector_to_matrix(np.radians(self.rotation_deg))
        return super().moved(np.concatenate([step[:6], axes @ step[6:]]))


class Shrinking(EllipsoidParameters):
    """Divides where it should multiply."""

    def moved(self, step: Array) -> Self:
        return super().moved(np.concatenate([step[:3], -step[3:6], step[6:]]))


class OneSided(EllipsoidParameters):
    """Takes the same step on both sides."""

    def mirrored_step(self, step: Array, reflection: Array = MIRROR) -> Array:
        return step


class Unmovable(EllipsoidParameters):
    """Has no free parameters."""

    def freedoms(self) -> tuple[Freedom, ...]:
        return ()


LAWS = [name for name in vars(StepLaws) if name.startswith("test_")]


def check(shape: type[ShapeModel], law: str, random: np.random.Generator) -> None:
    getattr(StepLaws(), law)(shape(), linkage(), random)


@pytest.mark.parametrize("law", LAWS)
def test_steps_without_a_fault_keep_the_law(law, random):
    check(Weighted, law, random)


def test_forgotten_weight_breaks_the_law(random):
    with pytest.raises(pytest.fail.Exception, match="weights are off"):
        check(Weightless, "test_shape_weights_are_those_of_its_primitives", random)


@pytest.mark.parametrize(
    ("parameters", "law", "words"),
    [
        (Shifted, "test_shape_step_of_zero_changes_nothing", "step of zero"),
        (Rounded, "test_shape_steps_are_smooth", "smoothly"),
        (Spun, "test_shape_steps_move_enlarge_and_rotate", "ROTATION"),
        (Swelling, "test_shape_steps_move_enlarge_and_rotate", "weight alone"),
        (Shrinking, "test_shape_steps_move_enlarge_and_rotate", "0.9.* times as large"),
        (OneSided, "test_shape_steps_are_mirrored", "mirror image"),
    ],
)
def test_faulty_steps_break_the_law(monkeypatch, random, parameters, law, words):
    monkeypatch.setattr(Faultless, "parameters", parameters)
    with pytest.raises(pytest.fail.Exception, match=words):
        check(Faultless, law, random)


def test_parameters_without_freedoms_are_skipped(monkeypatch, random):
    monkeypatch.setattr(Faultless, "parameters", Unmovable)
    with pytest.raises(pytest.skip.Exception):
        check(Faultless, LAWS[0], random)
