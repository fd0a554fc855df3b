"""Tapered capsules against spheres sampled along their axes, and descriptions that cannot be."""

from pathlib import Path

import numpy as np
import pytest

from regkit.body import BodyDescription
from regkit.config.document import Document
from regkit.geometry.capsules import Capsules
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.system.errors import ConfigError


def capsules(count: int, random: np.random.Generator) -> Capsules:
    """Tapers of all kinds, from thin bones to spheres that nearly hold the other one."""
    return Capsules(
        segments=random.integers(3, size=count),
        ends=random.normal(scale=0.3, size=(count, 2, 3)),
        radii=random.uniform(0.02, 0.15, size=(count, 2)),
    )


def one(start, end, first: float, last: float) -> Capsules:
    return Capsules(np.array([0]), np.array([[start, end]], dtype=float), np.array([[first, last]]))


def around(shape: Capsules, count: int, random: np.random.Generator) -> np.ndarray:
    """Points near a capsule: inside, close by and farther away."""
    middle = shape.ends.reshape(-1, 3).mean(axis=0)
    return middle + random.normal(scale=0.4, size=(count, 3))


def brute_force(shape: Capsules, points: np.ndarray, spheres: int = 4001) -> np.ndarray:
    """The least distance to the surfaces of spheres strung along the axis, for one capsule."""
    along = np.linspace(0.0, 1.0, spheres)[:, None]
    (start, end), (first, last) = shape.ends[0], shape.radii[0]
    centres = start + along * (end - start)
    radii = first + along[:, 0] * (last - first)
    return np.array([(np.linalg.norm(p - centres, axis=1) - radii).min() for p in points])


@pytest.mark.parametrize("seed", range(10))
def test_distance_is_that_to_the_nearest_sphere_on_the_axis(seed):
    random = np.random.default_rng(seed)
    shape = capsules(1, random)
    points = around(shape, 60, random)
    expected = brute_force(shape, points)
    found = shape.surface_distance(points)
    assert (expected < 0.0).any() or seed != 0
    # The true envelope is at most as far away as the sampled one.
    assert (found <= expected + 1e-9).all()
    np.testing.assert_allclose(found, expected, atol=2e-6)


@pytest.mark.parametrize("last", [0.02, 0.05, 0.1])
def test_distance_where_one_sphere_holds_the_other_is_that_of_the_larger(last, random):
    """At radii 0.2 and ``last``, 0.1 apart, the hull is the larger sphere."""
    points = random.normal(scale=0.4, size=(200, 3))
    start = np.array([0.1, 0.0, 0.3])
    end = np.array([0.1, 0.1, 0.3])
    expected = np.linalg.norm(points - start, axis=1) - 0.2
    for shape in (one(start, end, 0.2, last), one(end, start, last, 0.2)):
        np.testing.assert_allclose(shape.surface_distance(points), expected, atol=1e-5)


def test_capsule_of_one_point_is_a_sphere(random):
    centre = np.array([0.3, -0.2, 1.0])
    shape = one(centre, centre, 0.1, 0.1)
    points = centre + random.normal(scale=0.2, size=(100, 3))
    offset = points - centre
    radius = np.linalg.norm(offset, axis=1)
    _, distances, away = shape.nearest(points)
    np.testing.assert_allclose(distances, radius - 0.1, atol=1e-12)
    np.testing.assert_allclose(away, offset / radius[:, None], atol=1e-12)
    axis = shape.axis_points(0.01)
    np.testing.assert_array_equal(axis.points, [centre])
    np.testing.assert_array_equal(axis.radii, [0.1])


def test_cylinder_has_the_distances_of_a_cylinder():
    shape = one([0, 0, 0], [0, 1, 0], 0.1, 0.1)
    points = np.array([[0.3, 0.5, 0], [0, 1.4, 0], [0, -0.2, 0], [0, 0.5, 0.05], [0.3, 1.4, 0]])
    expected = [0.2, 0.3, 0.1, -0.05, 0.4]
    np.testing.assert_allclose(shape.surface_distance(points), expected, atol=1e-12)


def test_surface_of_several_is_that_of_the_nearest(random):
    shape = capsules(6, random)
    points = random.normal(scale=0.5, size=(80, 3))
    each = np.array([
        Capsules(shape.segments[k : k + 1], shape.ends[k : k + 1], shape.radii[k : k + 1])
        .surface_distance(points)
        for k in range(len(shape))
    ])  # fmt: skip
    nearest, distances, _ = shape.nearest(points)
    np.testing.assert_array_equal(nearest, each.argmin(axis=0))
    np.testing.assert_allclose(distances, each.min(axis=0), atol=1e-12)
    np.testing.assert_allclose(shape.surface_distance(points), distances, atol=1e-12)
    assert len(set(nearest)) > 1


@pytest.mark.parametrize("seed", range(5))
def test_gradient_agrees_with_finite_differences(seed):
    random = np.random.default_rng(seed)
    shape = capsules(4, random)
    points = random.normal(scale=0.5, size=(100, 3))
    step = 1e-6
    differences = np.column_stack([
        shape.surface_distance(points + step * e) - shape.surface_distance(points - step * e)
        for e in np.eye(3)
    ]) / (2 * step)  # fmt: skip
    away = shape.nearest(points)[2]
    np.testing.assert_allclose(np.linalg.norm(away, axis=1), 1.0, atol=1e-12)
    # On a ridge between two capsules the distance has no gradient.
    smooth = np.abs(np.linalg.norm(differences, axis=1) - 1.0) < 1e-5
    assert smooth.mean() > 0.95
    np.testing.assert_allclose(away[smooth], differences[smooth], atol=1e-5)


def test_distance_moves_with_the_segments(random):
    """``place(T)`` and T applied to the points tell the same distances."""
    shape = capsules(5, random)
    points = random.normal(scale=0.5, size=(50, 3))
    motion = rigid(vector_to_matrix(random.normal(size=3)), 3.0 * random.normal(size=3))
    placed = shape.place(np.tile(motion, (3, 1, 1)))
    moved = points @ motion[:3, :3].T + motion[:3, 3]
    nearest, distances, away = shape.nearest(points)
    nearest_there, distances_there, away_there = placed.nearest(moved)
    np.testing.assert_array_equal(nearest_there, nearest)
    np.testing.assert_allclose(distances_there, distances, atol=1e-7)
    np.testing.assert_allclose(away_there, away @ motion[:3, :3].T, atol=1e-7)


def test_placement_after_a_common_motion_is_the_motion_of_the_placement(random):
    """``place(G T) == G place(T)``, with another T for each segment."""
    shape = capsules(5, random)
    transforms = rigid(vector_to_matrix(random.normal(size=(3, 3))), random.normal(size=(3, 3)))
    motion = rigid(vector_to_matrix(random.normal(size=3)), random.normal(size=3))
    placed = shape.place(transforms)
    expected = placed.ends @ motion[:3, :3].T + motion[:3, 3]
    np.testing.assert_allclose(shape.place(motion @ transforms).ends, expected, atol=1e-12)
    np.testing.assert_array_equal(placed.radii, shape.radii)
    assert not np.allclose(placed.ends, shape.ends)


def test_distance_scales_with_the_body(random):
    shape = capsules(4, random)
    points = random.normal(scale=0.5, size=(50, 3))
    np.testing.assert_allclose(
        shape.scaled(1.7).surface_distance(1.7 * points),
        1.7 * shape.surface_distance(points),
        atol=1e-12,
    )


def test_axis_points_are_close_enough_and_on_the_axes(random):
    shape = capsules(4, random)
    points = shape.axis_points(0.05)
    # A point on the axis lies as deep within its own capsule as the capsule is thick there, or
    # deeper in a neighbour.
    assert (shape.surface_distance(points.points) <= -points.radii * 0.5).all()
    for segment, ends in zip(shape.segments, shape.ends, strict=True):
        own = points.points[points.segments == segment]
        for end in ends:
            assert np.linalg.norm(own - end, axis=1).min() < 1e-12
    first = one([0, 0, 0], [0, 0.3, 0.4], 0.1, 0.2).axis_points(0.06)
    assert np.linalg.norm(np.diff(first.points, axis=0), axis=1).max() <= 0.06 + 1e-12
    np.testing.assert_allclose(first.radii, np.linspace(0.1, 0.2, len(first.radii)))


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("radius: [0.1, 0.08]", "radius: [0.1, 0]", "segments.base.capsules[0].radius[1]: input "
         "should be greater than"),
        ("radius: [0.1, 0.08]", "radius: [0.1, .nan]", "FILE:7: segments.base.capsules[0].radius"),
        ("radius: [0.1, 0.08]", "radius: [0.1, 0.1, 0.1]", "FILE:7: segments.base.capsules[0]"),
        ("end: [0, 0.3, 0]", "end: [0, 0.3]", "FILE:7: segments.base.capsules[0].end"),
        ("end: [0, 0.3, 0], ", "", "FILE:7: segments.base.capsules[0].end: field required"),
        ("value: 1.0", "value: 0", "FILE:3: size.value: input should be greater than"),
        ("range: [0.5, 2.0]", "range: [2.0, 0.5]", "FILE:3: size.range: limits are reversed"),
        ("range: [0.5, 2.0]", "range: [0, 2.0]", "FILE:3: size.range[0]: input should be greater"),
        ("{origin: [0, 0, 0]}", "{tip: [0, 0, 0]}", "marker 'tip' is on 'base' and on "
         "'wrist'"),
        ("swing_deg: [60, 90]", "swing_deg: [60, 200]", "FILE:12: segments.arm.joint.swing_deg[1]: "
         "input should be less than or equal to 180; it is 200"),
        ("type: ball, swing", "type: ball, swing_axis: y, swing", "FILE:12: segments.arm.joint: "
         "twist_axis "),
        ("axis: [1, 1, 0]", "axis: w", "FILE:18: segments.forearm.joint.axis"),
    ],
)  # fmt: skip
def test_description_that_cannot_be_is_refused(tmp_path, linkage_text, old, new, expected):
    assert linkage_text.count(old) >= 1
    message = complaint(tmp_path / "body.yaml", linkage_text.replace(old, new, 1))
    assert expected in message


def complaint(path: Path, text: str) -> str:
    path.write_text(text)
    with pytest.raises(ConfigError) as caught:
        Document.read(path).validated(BodyDescription)
    return str(caught.value).replace(str(path), "FILE")
