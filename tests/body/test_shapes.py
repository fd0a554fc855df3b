"""Shape models whose parameters a template lists: checked, kept, deformed, bound and written."""

from pathlib import Path
from typing import Annotated, ClassVar, Literal, Self

import numpy as np
import pytest
from pydantic import Field, ValidationError

from regkit.body import (
    BallParameters,
    Body,
    BodyDescription,
    CapsuleParameters,
    Deformation,
    EllipsoidParameters,
    GaussianParameters,
    Mirror,
    ParametricShape,
    Scaling,
    ShapeParameters,
    Stretch,
    ellipsoids,
)
from regkit.body.groups import Groups
from regkit.body.proportions import Proportions
from regkit.body.writing import template_text
from regkit.calibration.shape import Shape
from regkit.config.document import Document
from regkit.config.plugin import register
from regkit.config.yaml import yaml_data
from regkit.fitting.template import parameters_of
from regkit.geometry.rotation import vector_to_matrix
from regkit.interfaces import ShapeModel
from regkit.primitives import Gaussians, Primitives
from regkit.skeleton.joints import Vector
from regkit.system.errors import ConfigError, PluginError

UNKNOWN = "shapes: {unheard: {base: [{width: [1, 2], odd: text}]}}\n"


class RodParameters(ShapeParameters):
    """Nothing like an ellipsoid: two ends and a thickness."""

    start: Vector
    """One end [m]."""
    end: Vector
    """The other end [m]."""
    thickness: Annotated[float, Field(gt=0.0)] = 0.01
    """Standard deviation across the rod [m]."""

    def deformed(self, deformation: Deformation) -> Self:
        changed = {
            "start": deformation.point(self.start),
            "end": deformation.point(self.end),
            "thickness": deformation.radius(self.thickness),
        }
        return self.model_copy(update=changed)

    def moments(self) -> tuple[np.ndarray, np.ndarray]:
        start, end = np.array(self.start), np.array(self.end)
        spread = np.outer(end - start, end - start) / 12.0
        return 0.5 * (start + end), spread + self.thickness**2 * np.eye(3)

    @classmethod
    def fitted(cls, points: np.ndarray, like: Self | None = None) -> Self:
        low, high = points.min(axis=0), points.max(axis=0)
        return cls(start=tuple(low.tolist()), end=tuple(high.tolist()))


class Rods(ShapeModel):
    """A round Gaussian in the middle of each rod that the template lists."""

    kind: Literal["rods"] = "rods"
    makes: ClassVar[type[Primitives]] = Gaussians
    parameters: ClassVar[type[ShapeParameters] | None] = RodParameters

    def bind(self, body: Body) -> Gaussians:
        listed = body.shapes[self.kind]
        count = len(listed)
        return Gaussians(
            segments=listed.segments,
            centres=np.array([one.moments()[0] for one in listed.parameters]),
            axes=np.tile(np.eye(3), (count, 1, 1)),
            scales=np.array([[one.thickness] * 3 for one in listed.parameters]),
            weights=np.ones(count),
        )


@pytest.fixture
def rods() -> None:
    register(Rods)


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "template.yaml"


@pytest.fixture
def read(file, linkage_text):
    def described(more: str) -> BodyDescription:
        file.write_text(linkage_text + more)
        return Document.read(file).validated(BodyDescription)

    return described


@pytest.fixture
def complaint(file, read):
    def told(more: str) -> str:
        with pytest.raises(ConfigError) as caught:
            read(more)
        return str(caught.value).replace(str(file), "FILE")

    return told


RODS = """\
shapes:
  rods:
    base:
      - {start: [0.1, 0, 0], end: [0.1, 0.2, 0.04], thickness: 0.02}
    forearm:
      - {start: [0, 0, 0], end: [0, -0.1, 0]}
"""


def unlike(description: BodyDescription) -> Proportions:
    groups = Groups.of(description)
    lengths = np.linspace(0.8, 1.3, len(groups.names))
    return Proportions(groups, lengths, lengths[::-1])


@pytest.mark.usefixtures("rods")
def test_a_shape_model_finds_its_own_parameters_at_the_body_s_size(read):
    bound = Rods().bind(read(RODS).body("thing", 2.0))
    np.testing.assert_allclose(bound.centres, [[0.2, 0.2, 0.04], [0.0, -0.1, 0.0]])
    np.testing.assert_allclose(bound.scales[:, 0], [0.04, 0.02])


@pytest.mark.usefixtures("rods")
def test_parameters_are_stretched_by_their_own_class(read):
    description = read(RODS)
    proportions = unlike(description)
    rod = proportions.applied(description).shapes["rods"]["base"][0]
    index = proportions.groups.names.index("base")
    length, girth = proportions.lengths[index], proportions.girths[index]
    bone = proportions.groups.bones[0]
    along = bone @ np.array([0.1, 0.2, 0.04])
    assert bone @ rod.end == pytest.approx(length * along)
    assert rod.thickness == pytest.approx(girth * 0.02)


@pytest.mark.usefixtures("rods")
def test_parameters_are_written_as_they_are_read(read, tmp_path):
    description = read(RODS)
    again = tmp_path / "again.yaml"
    again.write_text(template_text(description, "Again.", {}))
    assert Document.read(again).validated(BodyDescription).shapes == description.shapes


@pytest.mark.usefixtures("rods")
@pytest.mark.parametrize(
    ("old", "new", "place", "words"),
    [
        ("thickness: 0.02", "thickness: -1", "FILE:40: shapes.rods.base[0].thickness", "greater"),
        ("thickness: 0.02", "thicknes: 1", "FILE:40: shapes.rods.base[0].thicknes", "thickness"),
        ("end: [0, -0.1, 0]", "thickness: 1.0", "FILE:42: shapes.rods.forearm[0].end", "required"),
        ("    forearm:", "    foream:", "FILE:41: shapes.rods.foream", "'forearm'"),
        ("      - {start: [0, 0, 0]", "        {start: [0, 0, 0]", "FILE:41: shapes.rods.forearm",
         "list"),
    ],
)  # fmt: skip
def test_wrong_parameters_are_told_at_their_place(complaint, old, new, place, words):
    (line,) = complaint(RODS.replace(old, new)).splitlines()
    assert line.startswith(f"{place}: ")
    assert words in line


@pytest.mark.usefixtures("rods")
def test_everything_that_is_wrong_is_told_at_once(complaint):
    wrong = RODS.replace("0.02}", "-1}") + "  sog: {base: [{centre: [0, 0, 0], sigma: wide}]}\n"
    first, second = complaint(wrong).splitlines()
    assert "shapes.rods.base[0].thickness" in first
    assert "shapes.sog.base[0].sigma" in second


@pytest.mark.parametrize("sigma", ["[0.1, 0.2, 0.1]", "0"])
def test_isotropic_gaussians_have_one_sigma(complaint, sigma):
    told = complaint(f"shapes: {{sog: {{base: [{{centre: [0, 0, 0], sigma: {sigma}}}]}}}}\n")
    assert told.startswith("FILE:37: shapes.sog.base[0].sigma: ")


def test_a_shape_model_without_parameters_is_refused(complaint):
    told = complaint("shapes: {mesh: {base: [{radius: 1}]}}\n")
    assert told.startswith("FILE:37: shapes.mesh: ")
    assert "'mesh' has no parameters" in told


def test_the_old_field_is_answered_with_the_new_one(complaint):
    told = complaint("gaussians: {gsog: {base: [{centre: [0, 0, 0], sigma: 0.1}]}}\n")
    assert told.startswith("FILE:37: gaussians: ")
    assert "'shapes'" in told


def test_a_shape_model_that_is_not_installed_harms_no_other(read):
    description = read(UNKNOWN)
    assert "no plug-in 'unheard'" in description.unchecked()["unheard"]
    body = description.body("thing", 2.0)
    assert not body.shapes
    assert len(ShapeModel.load("gsog")().bind(body))


def test_parameters_without_their_shape_model_are_kept_word_for_word(read, tmp_path):
    again = tmp_path / "again.yaml"
    again.write_text(template_text(read(UNKNOWN), "Again.", {}))
    listed = Document.read(again).data["shapes"]["unheard"]
    assert listed == {"base": [{"width": [1, 2], "odd": "text"}]}


def test_parameters_without_their_shape_model_are_not_stretched(read):
    description = read(UNKNOWN)
    for stretched in (unlike(description).applied, Shape):
        with pytest.raises(ConfigError, match=r"shapes\.unheard: .*no plug-in 'unheard'"):
            stretched(description)


def test_parameters_without_their_shape_model_stand_on_segments_too(complaint):
    assert "'bse' is not a segment" in complaint(UNKNOWN.replace("base", "bse"))
    assert "mapping" in complaint("shapes: {unheard: {base: [3]}}\n")


@pytest.mark.usefixtures("rods")
def test_a_shape_model_must_name_a_class_of_parameters(monkeypatch, read):
    monkeypatch.setattr(Rods, "parameters", int)
    with pytest.raises(PluginError, match="'rods' must set 'parameters'"):
        parameters_of("rods")
    assert "parameters" in read(RODS).unchecked()["rods"]


@pytest.mark.parametrize(("kind", "error"), [("mesh", ConfigError), ("gsg", PluginError)])
def test_a_shape_model_without_parameters_cannot_be_fitted(kind, error):
    with pytest.raises(error, match=f"'{kind}'"):
        parameters_of(kind)


SOLIDS = (
    EllipsoidParameters(
        centre=(0.1, -0.2, 0.3), sigma=(0.1, 0.2, 0.05), rotation_deg=(10.0, -30.0, 50.0)
    ),
    EllipsoidParameters(centre=(0.1, -0.2, 0.3), sigma=0.1),
    BallParameters(centre=(0.1, -0.2, 0.3), sigma=0.1),
    CapsuleParameters(start=(0.1, -0.2, 0.3), end=(0.2, 0.1, 0.3), radius=(0.1, 0.05)),
    CapsuleParameters(start=(0.1, -0.2, 0.3), end=(0.1, -0.2, 0.3), radius=0.1),
)


@pytest.mark.parametrize("solid", SOLIDS)
def test_scaled_and_mirrored_moments_are_those_of_scaled_and_mirrored_points(solid):
    mean, covariance = solid.moments()
    for deformation, matrix in (
        (Scaling(1.7), 1.7 * np.eye(3)),
        (Mirror(), np.diag([-1.0, 1.0, 1.0])),
    ):
        after, spread = solid.deformed(deformation).moments()
        np.testing.assert_allclose(after, matrix @ mean, atol=1e-12)
        np.testing.assert_allclose(spread, matrix @ covariance @ matrix.T, atol=1e-12)
    assert solid.deformed(Mirror()).deformed(Mirror()) == solid


@pytest.mark.parametrize("solid", SOLIDS)
def test_a_stretch_of_one_factor_is_a_scaling(solid):
    stretch = Stretch.along(np.array([0.6, 0.0, 0.8]), 1.3, 1.3)
    for one, other in zip(
        solid.deformed(stretch).moments(), solid.deformed(Scaling(1.3)).moments(), strict=True
    ):
        np.testing.assert_allclose(one, other, atol=1e-12)


def test_a_stretch_along_an_axis_of_a_solid_lengthens_that_axis_alone():
    turn = np.radians(SOLIDS[0].rotation_deg)
    bone = vector_to_matrix(turn)[:, 1]
    after = SOLIDS[0].deformed(Stretch.along(bone, 1.5, 0.8))
    np.testing.assert_allclose(after.sigma, np.array([0.8, 1.5, 0.8]) * SOLIDS[0].sigma)


def test_a_fitted_solid_has_the_moments_of_the_points_and_the_form_of_its_like(random):
    points = random.normal(size=(5000, 3)) * [0.03, 0.2, 0.1] + [0.1, 0.2, 0.3]
    mean, covariance = EllipsoidParameters.fitted(points, SOLIDS[0]).moments()
    np.testing.assert_allclose(mean, points.mean(axis=0), atol=1e-4)
    np.testing.assert_allclose(covariance, np.cov(points.T), atol=1e-4)
    for like in SOLIDS[1:3]:
        found = type(like).fitted(points, like)
        assert found.sigma == pytest.approx(np.sqrt(points.var(axis=0).mean()), abs=1e-4)
    assert isinstance(BallParameters.fitted(points).sigma, float)


def test_listed_ellipsoids_are_arrays_of_their_moments(read):
    listed = "{centre: [0, 0.1, 0], sigma: [0.1, 0.2, 0.3], rotation_deg: [0, 0, 90]}"
    body = read(f"shapes: {{gsog: {{arm: [{listed}]}}}}\n").body("thing", 1.0)
    gaussians = Gaussians(*ellipsoids(body.shapes["gsog"]))
    assert gaussians.segments == body.skeleton.names.index("arm")
    covariance = gaussians.place(np.tile(np.eye(4), (6, 1, 1))).covariances()[0]
    np.testing.assert_allclose(covariance, np.diag([0.2, 0.1, 0.3]) ** 2, atol=1e-12)


@pytest.mark.parametrize("kind", ["gsog", "sog"])
def test_weights_are_listed_read_and_written_unless_they_are_one(kind, read):
    plain, heavy = "centre: [0, 0.1, 0], sigma: 0.1", "centre: [0, 0.2, 0], sigma: 0.2"
    listed = f"{{{plain}}}, {{{heavy}, weight: 2.5}}"
    description = read(f"shapes: {{{kind}: {{arm: [{listed}]}}}}\n")
    one, two = description.shapes[kind]["arm"]
    assert "weight" not in one.yaml()
    assert "weight: 2.5000" in two.yaml()
    assert type(two).model_validate(yaml_data(two.yaml(), "solid")) == two
    bound = ParametricShape.load(kind)().bind(description.body("thing", 2.0))
    np.testing.assert_array_equal(bound.weights, [1.0, 2.5])


@pytest.mark.parametrize("weight", [0.0, -1.0, 1e5, float("nan")])
def test_a_weight_is_positive_and_bounded(weight):
    with pytest.raises(ValidationError, match="weight"):
        GaussianParameters(centre=(0.0, 0.0, 0.0), sigma=0.1, weight=weight)


def test_a_solid_without_extent_is_refused():
    with pytest.raises(ValidationError):
        BallParameters(centre=(0.0, 0.0, 0.0), sigma=0.0)
