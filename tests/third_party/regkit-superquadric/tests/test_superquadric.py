"""What is special to superquadrics, and that regkit takes them as its own."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from regkit_superquadric import RadialDistance, Superellipsoids, Superquadric, gauge

from regkit.body import Body
from regkit.geometry.capsules import Capsules
from regkit.observation import Observation
from regkit.registration import Robust
from regkit.testing.samples import linkage

EXAMPLE = Path(__file__).parents[1] / "examples" / "superquadric.yaml"


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


def regkit(*arguments: object) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "regkit", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.mark.slow
def test_example_runs_beside_icp_with_measures_and_pictures(tmp_path):
    ended = regkit("run", EXAMPLE, "--out", tmp_path / "out", "--set", "dataset.frames=3")
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
    assert "Radius as a part of the capsule's mean radius." in text


def test_kernel_refuses_other_shapes_when_the_configuration_is_read(tmp_path):
    file = tmp_path / "wrong.yaml"
    file.write_text(EXAMPLE.read_text().replace("shape: superquadric", "shape: gsog"))
    ended = regkit("validate", file)
    assert ended.returncode == 1
    assert (
        "kernel 'radial_distance' compares Superellipsoids, but shape 'gsog' makes" in ended.stderr
    )
