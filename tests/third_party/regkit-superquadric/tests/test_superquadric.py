"""What is special to superquadrics, and that regkit takes them as its own."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from regkit_superquadric import RadialDistance, Superellipsoids, Superquadric, gauge

import regkit_plugins
from regkit.body import Body, BodyDescription
from regkit.body.groups import Groups
from regkit.body.proportions import Proportions
from regkit.config.document import Document
from regkit.geometry.capsules import Capsules
from regkit.observation import Observation
from regkit.registration import Robust
from regkit.testing.samples import linkage

EXAMPLES = Path(__file__).parents[1] / "examples"
EXAMPLE, PERSON = EXAMPLES / "superquadric.yaml", EXAMPLES / "person.yaml"
SKIN = Path(regkit_plugins.__file__).parent / "templates" / "human_mesh.npz"
WALK = Path(__file__).parents[4] / "docs" / "examples" / "data" / "human_walk"


SQUARES = Robust(loss="squares", scale=0.1)


def of(start, end, radius) -> Superellipsoids:
    """The superellipsoid of one capsule."""
    body = linkage()
    capsules = Capsules(
        np.zeros(1, dtype=np.intp), np.array([[start, end]]), np.full((1, 2), radius)
    )
    return Superquadric().bind(Body(**{**vars(body), "capsules": capsules}))


def test_ball_stays_a_ball_and_its_radial_distance_is_the_distance():
    ball = of([0.1, 0.0, 0.0], [0.1, 0.0, 0.0], 0.2)
    assert ball.exponents == pytest.approx(2.0)
    points = np.array([[0.5, 0.0, 0.0], [0.1, 0.1, 0.1]])
    placed = ball.place(np.eye(4)[None])
    expected = np.linalg.norm(points - [0.1, 0.0, 0.0], axis=1) - 0.2
    for point, distance in zip(points, expected, strict=True):
        data = Observation(point[None], np.ones(1), np.full(1, 1e-4))
        energy = RadialDistance(robust=SQUARES).bind(data, placed)(placed).energy
        assert energy == pytest.approx(0.5 * (distance / 0.1) ** 2)


def test_point_at_a_centre_is_as_deep_as_the_solid_is_wide():
    solid = of([0.1, 0.0, 0.0], [0.4, 0.0, 0.0], 0.2)
    placed = solid.place(np.eye(4)[None])
    data = Observation(placed.centres.copy(), np.ones(1), np.full(1, 1e-4))
    answer = RadialDistance(robust=SQUARES).bind(data, placed)(placed, curvature=True)
    assert answer.energy == pytest.approx(0.5 * 2.0**2)
    assert np.isfinite(answer.wrenches).all()


@pytest.mark.parametrize("length", [0.05, 0.2, 0.6])
def test_volume_is_that_of_the_capsule(length, random):
    solid = of([0.0, 0.0, 0.0], [length, 0.0, 0.0], 0.1)
    reach = 2.0 * solid.scales[0]
    points = random.uniform(-reach, reach, size=(200_000, 3))
    inside = gauge(points, solid.scales[:1], solid.exponents[:1])[0] <= 1.0
    volume = inside.mean() * np.prod(2.0 * reach)
    assert volume == pytest.approx(np.pi * 0.01 * (length + 4.0 / 3.0 * 0.1), rel=0.02)


def test_surface_points_lie_on_the_surface():
    solids = Superquadric().bind(linkage())
    values, _ = gauge(solids.surface_points(), solids.scales[:, None], solids.exponents[:, None])
    np.testing.assert_allclose(values, 1.0)


def test_girth_widens_and_does_not_lengthen():
    thin, thick = Superquadric().bind(linkage()), Superquadric(girth=2.0).bind(linkage())
    np.testing.assert_allclose(thick.scales, thin.scales * [2.0, 1.0, 2.0])


def person(tmp_path, old: str = "", new: str = "") -> Path:
    """The template that ships with fitted parameters, with a change in it."""
    file = tmp_path / "person.yaml"
    file.write_text(PERSON.read_text().replace(old, new))
    return file


def read(file: Path) -> BodyDescription:
    return Document.read(file).validated(BodyDescription)


def test_listed_solids_have_the_moments_that_the_template_lists(tmp_path, random):
    rotation = "rotation_deg: [14, -0.2, -0.9]"
    file = person(tmp_path, rotation, f"{rotation}, exponent: 5.0")
    description = read(file)
    body = description.body("person", description.size.value)
    solids = Superquadric().bind(body)
    assert len(solids) == len(description.segments)
    first, other = solids.scales[0], solids.exponents
    assert (other[0], *other[1:]) == (5.0, *[2.0] * (len(other) - 1))
    points = random.uniform(-2.0 * first, 2.0 * first, size=(400_000, 3))
    inside = points[gauge(points, first, 5.0)[0] <= 1.0]
    sigma = body.shapes["superquadric"].parameters[0].sigma
    np.testing.assert_allclose(inside.std(axis=0), sigma, rtol=0.01)


def test_listed_solids_grow_with_the_body():
    description = read(PERSON)
    small, large = (Superquadric().bind(description.body("person", size)) for size in (1.5, 1.8))
    np.testing.assert_allclose(large.scales, 1.2 * small.scales)
    np.testing.assert_allclose(large.centres, 1.2 * small.centres)
    np.testing.assert_array_equal(large.exponents, small.exponents)


def test_wrong_exponent_is_told_at_its_place(tmp_path):
    file = person(tmp_path, "rotation_deg: [14, -0.2, -0.9]", "exponent: 1.0")
    ended = regkit("validate", file)
    assert ended.returncode == 1
    assert f"{file}:" in ended.stderr
    assert "shapes.superquadric.pelvis[0].exponent" in ended.stderr


def test_calibration_stretches_the_listed_solids():
    description = read(PERSON)
    groups = Groups.of(description)
    girths = np.where(np.array(groups.names) == "thigh", 1.2, 1.0)
    subject = Proportions(groups, np.ones(len(girths)), girths).applied(description)
    for side in ("left", "right"):
        before, after = (one.shapes["superquadric"][f"{side}_thigh"][0].sigma
                         for one in (description, subject))  # fmt: skip
        # Its longest axis leans a little from the bone.
        np.testing.assert_allclose(after, np.array([1.2, 1.0, 1.2]) * before, rtol=0.02)
    before, after = (one.shapes["superquadric"]["chest"][0] for one in (description, subject))
    np.testing.assert_allclose(after.sigma, before.sigma)
    np.testing.assert_allclose(after.centre, before.centre)


def regkit(*arguments: object) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "regkit", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.mark.long
def test_template_with_fitted_solids_is_calibrated(tmp_path):
    out = tmp_path / "subject.yaml"
    template = f"{{kind: file, path: {PERSON}, size: 1.7}}"
    ended = regkit("calibrate", WALK, "--template", template, "--frames", "2", "--out", out)
    assert ended.returncode == 0, ended.stderr
    before, after = read(PERSON).shapes["superquadric"], read(out).shapes["superquadric"]
    assert after.keys() == before.keys()
    assert after != before


@pytest.mark.long
def test_solids_are_fitted_to_a_mesh(tmp_path):
    out = tmp_path / "fitted.yaml"
    ended = regkit("fit", SKIN, "--shape", "superquadric", "--out", out)
    assert ended.returncode == 0, ended.stderr
    fitted = read(out).shapes["superquadric"]
    for name, (solid,) in read(PERSON).shapes["superquadric"].items():
        (own,) = fitted[name]
        for one, other in zip(own.moments(), solid.moments(), strict=True):
            assert np.linalg.norm(one - other) < 0.03


@pytest.mark.long
def test_solids_that_a_template_lists_are_fitted_with_their_exponents(tmp_path):
    rotation = "rotation_deg: [14, -0.2, -0.9]"
    file = person(tmp_path, rotation, f"{rotation}, exponent: 5.0")
    out = tmp_path / "fitted.yaml"
    ended = regkit("fit", SKIN, "--template", file, "--out", out)
    assert ended.returncode == 0, ended.stderr
    before, after = read(file).shapes["superquadric"], read(out).shapes["superquadric"]
    for name, (solid,) in before.items():
        (own,) = after[name]
        assert own.exponent == solid.exponent
        for one, other in zip(own.moments(), solid.moments(), strict=True):
            assert np.linalg.norm(one - other) < 0.03


@pytest.mark.long
def test_example_runs_beside_icp_with_measures_and_pictures(tmp_path):
    ended = regkit("run", EXAMPLE, "--out", tmp_path / "out", "--set", "dataset.frames=2",
                   "--no-figures")  # fmt: skip
    assert ended.returncode == 0, ended.stderr
    methods = json.loads((tmp_path / "out" / "metrics.json").read_text())["methods"]
    assert set(methods) == {"superquadric", "icp"}
    picture = tmp_path / "out" / "superquadric" / "human_walk" / "overlay.png"
    assert picture.stat().st_size > 10_000


def test_schema_of_the_user_knows_the_plugins(tmp_path):
    assert regkit("schema", tmp_path).returncode == 0
    text = (tmp_path / "experiment.json").read_text()
    assert '"superquadric"' in text
    assert '"radial_distance"' in text
    assert "Radius as a part of the template's." in text
    assert "the more it is a cylinder" in (tmp_path / "template.json").read_text()


def test_kernel_refuses_other_shapes_when_the_configuration_is_read(tmp_path):
    file = tmp_path / "wrong.yaml"
    file.write_text(EXAMPLE.read_text().replace("shape: superquadric", "shape: gsog"))
    ended = regkit("validate", file)
    assert ended.returncode == 1
    assert (
        "kernel 'radial_distance' compares Superellipsoids, but shape 'gsog' makes" in ended.stderr
    )
