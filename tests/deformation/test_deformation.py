"""Displacement fields: smooth, independent of units and of the world's origin, fitted to clouds."""

import json

import numpy as np
import pytest

import regkit
from regkit.deformation import DisplacementField, Features
from regkit.system.errors import ConfigError


def bar(random: np.random.Generator, count: int) -> np.ndarray:
    """Points on the surface of a bar of 2 x 0.4 x 0.3 with a knob on one end."""
    sizes = np.array([1.0, 0.2, 0.15])
    points = random.uniform(-1.0, 1.0, size=(count, 3)) * sizes
    side = random.integers(1, 3, size=count)
    rows = np.arange(count)
    points[rows, side] = np.sign(points[rows, side]) * sizes[side]
    knob = random.uniform(size=count) < 0.15
    way = random.normal(size=(int(knob.sum()), 3))
    points[knob] = [0.9, 0.3, 0.0] + 0.15 * way / np.linalg.norm(way, axis=1)[:, None]
    return points


def bent(points: np.ndarray) -> np.ndarray:
    """The bar bent upwards, thicker at one end, and a little longer."""
    x, y, z = points.T
    return np.column_stack([1.05 * x, y + 0.15 * x**2, z * (1.0 + 0.2 * x)])


def error(moved: np.ndarray, points: np.ndarray) -> float:
    return float(np.linalg.norm(moved - points, axis=1).mean())


def test_features_have_the_covariance_of_the_process(random) -> None:
    centres = random.normal(size=(60, 3))
    features = Features.of(centres, 0.7)
    values = features.at(centres)
    apart = np.linalg.norm(centres[:, None] - centres, axis=2)
    np.testing.assert_allclose(values @ values.T, np.exp(-0.5 * (apart / 0.7) ** 2), atol=2e-3)


def test_a_field_does_not_depend_on_the_origin(random) -> None:
    features = Features.of(random.normal(size=(20, 3)), 0.8)
    weights = random.normal(size=(features.weights.shape[1] + 4, 3))
    field = DisplacementField(np.array([1.0, 2.0, 3.0]), 0.5, features, weights)
    points, origin = random.normal(size=(30, 3)), np.array([4.0, -5.0, 6.0])
    np.testing.assert_allclose(
        field.shifted(origin).moved(points + origin), field.moved(points) + origin, atol=1e-9
    )


@pytest.mark.parametrize("unit", [1.0, 1000.0])
def test_a_smooth_deformation_is_recovered_in_any_unit(random, unit) -> None:
    source, target = bar(random, 1500), bent(bar(random, 1500))
    found = regkit.align(unit * source, unit * target, "nonrigid")
    rigid = found.aligned - found.displacements
    moved = error(found.aligned / unit, bent(source))
    assert moved < 0.04
    assert moved < 0.6 * error(rigid / unit, bent(source))


def test_points_that_were_not_registered_move_with_the_others(random) -> None:
    source, target = bar(random, 1500), bent(bar(random, 1500))
    found = regkit.align(source, target, "nonrigid").found
    others = bar(random, 20_000)
    assert error(found.moved(others), bent(others)) < 0.05


def test_stray_points_do_not_pull(random) -> None:
    source, target = bar(random, 1500), bent(bar(random, 1500))
    stray = random.uniform(-1.5, 1.5, size=(200, 3))
    found = regkit.align(source, np.concatenate([target, stray]), {"kind": "nonrigid"})
    assert error(found.aligned, bent(source)) < 0.06


def test_a_deformation_that_does_nothing_is_told(regkit, tmp_path, random) -> None:
    source = bar(random, 1500)
    np.savetxt(tmp_path / "a.xyz", source)
    np.savetxt(tmp_path / "b.xyz", np.add(source, [0.01, 0.0, 0.0]))
    ended = regkit("align", tmp_path / "a.xyz", tmp_path / "b.xyz", "--method", "nonrigid")
    assert "does nothing" in ended.err


def test_the_deformed_cloud_is_written(regkit, tmp_path, random) -> None:
    source, target = bar(random, 1500), bent(bar(random, 1500))
    np.savetxt(tmp_path / "a.xyz", source)
    np.savetxt(tmp_path / "b.xyz", target)
    command = ("align", tmp_path / "a.xyz", tmp_path / "b.xyz", "--method", "nonrigid")
    ended = regkit(*command, "--out", tmp_path / "moved.xyz", "--json")
    assert ended.code == 0, ended.err
    assert error(np.loadtxt(tmp_path / "moved.xyz"), bent(source)) < 0.04
    assert json.loads(ended.out)["displacement"]["largest"] > 0.05


def test_a_body_without_surface_is_refused(random) -> None:
    from regkit.body import BodyDescription
    from regkit.interfaces import Method

    body = BodyDescription.model_validate(
        {
            "title": "A ball.",
            "size": {"name": "width", "value": 1.0, "range": [1.0, 1.0]},
            "segments": {
                "ball": {
                    "joint": {"type": "free"},
                    "capsules": [{"start": [0, 0, 0], "end": [0, 0, 0], "radius": 0.5}],
                }
            },
        }
    ).body("ball", 1.0)
    with pytest.raises(ConfigError, match="surface"):
        Method.parse("nonrigid", place="test", field="method").bind(body)
