"""The laws of shape models' parameters catch faults."""

from typing import ClassVar, Literal, Self

import numpy as np
import pytest

from regkit.body import Body, Deformation, EllipsoidParameters, ShapeParameters, ellipsoids
from regkit.interfaces import ShapeModel
from regkit.primitives import Gaussians, Primitives
from regkit.testing.parameter_laws import ParameterLaws
from regkit.testing.samples import linkage


class Faultless(ShapeModel):
    """Gaussians that a template lists."""

    kind: Literal["faultless"] = "faultless"
    makes: ClassVar[type[Primitives]] = Gaussians
    parameters: ClassVar[type[ShapeParameters] | None] = EllipsoidParameters

    def bind(self, body: Body) -> Gaussians:
        return Gaussians(*ellipsoids(body.shapes[self.kind]))


class Rigid(EllipsoidParameters):
    """Stays as it is in every deformation."""

    def deformed(self, deformation: Deformation) -> Self:
        return self


class Upright(EllipsoidParameters):
    """Forgets to mirror its rotation."""

    def deformed(self, deformation: Deformation) -> Self:
        return super().deformed(deformation).model_copy(update={"rotation_deg": self.rotation_deg})


class Elsewhere(EllipsoidParameters):
    """Is fitted to other points."""

    @classmethod
    def fitted(cls, points: np.ndarray, like: Self | None = None) -> Self:
        return super().fitted(points + 1.0, like)


class Astray(EllipsoidParameters):
    """Stands for another capsule."""

    @classmethod
    def of_capsule(cls, ends: np.ndarray, radii: np.ndarray) -> Self:
        return super().of_capsule(ends + 1.0, radii)


class Terse(EllipsoidParameters):
    """Writes its middle alone."""

    def yaml(self) -> str:
        return f"{{centre: {list(self.centre)}, sigma: 0.1}}"


class Unmoved(Faultless):
    """Does not take the sizes that are listed."""

    def bind(self, body: Body) -> Gaussians:
        gaussians = super().bind(body)
        return Gaussians(
            gaussians.segments, gaussians.centres, gaussians.axes, 0.1 + 0.0 * gaussians.scales,
            gaussians.weights,
        )  # fmt: skip


LAWS = [name for name in vars(ParameterLaws) if name.startswith("test_")]


def check(shape: type[ShapeModel], law: str, random: np.random.Generator) -> None:
    getattr(ParameterLaws(), law)(shape(), linkage(), random)


@pytest.mark.parametrize("law", LAWS)
def test_parameters_without_a_fault_keep_the_law(law, random):
    check(Faultless, law, random)


@pytest.mark.parametrize(
    ("parameters", "law", "words"),
    [
        (Rigid, "test_shape_parameters_follow_the_segment", "after a Scaling"),
        (Upright, "test_shape_parameters_follow_the_segment", "covariance.*after a Mirror"),
        (Elsewhere, "test_shape_fits_its_parameters", "from the points"),
        (Astray, "test_shape_stands_for_a_capsule", "from the capsule"),
        (Terse, "test_shape_parameters_are_written_as_they_are_read", "sigma: 0.1}"),
        (Rigid, "test_shape_takes_the_parameters_of_the_body", "scaled"),
    ],
)
def test_faulty_parameters_break_the_law(monkeypatch, random, parameters, law, words):
    monkeypatch.setattr(Faultless, "parameters", parameters)
    with pytest.raises(pytest.fail.Exception, match=words):
        check(Faultless, law, random)


def test_a_shape_that_ignores_what_is_listed_breaks_the_law(random):
    with pytest.raises(pytest.fail.Exception, match="scaled"):
        check(Unmoved, "test_shape_takes_the_parameters_of_the_body", random)


def test_a_shape_without_parameters_is_skipped(random):
    with pytest.raises(pytest.skip.Exception):
        check(ShapeModel.load("mesh"), LAWS[0], random)
