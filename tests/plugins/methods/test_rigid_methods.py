"""Rigid registration: regkit's method and those of other libraries, by the same road."""

import builtins
import importlib

import numpy as np
import pytest

from regkit.alignment import agreement, align
from regkit.alignment.normalization import Normalization
from regkit.alignment.weak_motion import weak_motion
from regkit.cli.choices import method_named
from regkit.geometry.rigid import inverse, rigid, transformed
from regkit.geometry.rotation import from_matrix, to_vector, vector_to_matrix
from regkit.search.rotations import icosahedral
from regkit.system.errors import ConfigError, DataError, DependencyError
from regkit_plugins.templates.human import Human

METHODS = {
    "rigid": "regkit",
    "{preset: rigid, shape: cloud_sog, kernel: {flatness: 1}}": "regkit",
    "{kind: direct, shape: cloud_gsog, kernel: local_likelihood, solver: gauss_newton, "
    "annealing: [0.03, 0.01, 0, 0]}": "regkit",
    "{kind: open3d_icp, estimation: point_to_point}": "open3d",
    "open3d_icp": "open3d",
    "{kind: open3d_icp, estimation: generalized}": "open3d",
    "small_gicp": "small_gicp",
    "probreg_cpd": "probreg",
    "{kind: probreg_filterreg, shrinking: true}": "probreg",
    "biocpd": "biocpd",
}


def errors(found, truth):
    """Degrees, and metres at the lump's centre."""
    off = inverse(truth) @ found
    return np.degrees(np.linalg.norm(to_vector(from_matrix(off[:3, :3])))), np.linalg.norm(
        transformed(off, np.array([[0.5, -0.2, 1.0]])) - [0.5, -0.2, 1.0]
    )


@pytest.fixture
def truth():
    return rigid(vector_to_matrix(np.array([0.1, -0.15, 0.1])), np.array([0.2, -0.1, 0.3]))


@pytest.fixture
def pair(lump, random, truth):
    """Different points of the lump, each cloud with a millimetre of noise."""
    source, target = lump[:800], transformed(truth, lump[700:])
    return (cloud + 0.001 * random.normal(size=cloud.shape) for cloud in (source, target))


@pytest.mark.parametrize("name", METHODS)
@pytest.mark.filterwarnings("default")  # Other libraries may warn of what they like.
def test_method_recovers_a_known_motion(pair, truth, name):
    pytest.importorskip(METHODS[name])
    found = align(*pair, method_named(name), start="centroids")
    degrees, metres = errors(found.transform, truth)
    # Round Gaussians slide less, and CPD ends early with its default number of steps.
    assert degrees < (8.0 if name == "probreg_cpd" or "cloud_sog" in name else 3.0)
    assert metres < 0.01
    assert found.agreement.fitness > 0.95


@pytest.mark.parametrize("degrees", [60.0, 100.0])
def test_rigid_sees_far(lump, random, degrees):
    axis = np.array([1.0, 2.0, -1.0]) / np.sqrt(6.0)
    truth = rigid(vector_to_matrix(np.radians(degrees) * axis), np.array([1.0, 0.0, 0.0]))
    start = "centroids" if degrees < 90.0 else "rotations"
    found = align(lump, transformed(truth, lump), method_named("rigid"), start=start)
    assert errors(found.transform, truth)[0] < 0.5


@pytest.mark.parametrize("start", ["centroids", "rotations"])
def test_threads_change_no_bit(lump, truth, start):
    several = np.concatenate([lump, 1.01 * lump, 0.99 * lump])
    pair = several[::2], transformed(truth, several[1::2])
    found = [
        align(*pair, method_named(method), voxel=0.0, start=start, threads=threads)
        for method, threads in (
            ("rigid", None),
            ("rigid", 2),
            ("{preset: rigid, threads: 3}", None),
        )
    ]
    for other in found[1:]:
        np.testing.assert_array_equal(other.transform, found[0].transform)
        assert other.agreement == found[0].agreement


@pytest.mark.parametrize("voxel", [-0.1, np.nan, np.inf])
def test_voxel_that_is_no_length_is_refused(lump, voxel):
    with pytest.raises(ConfigError, match="voxel"):
        align(lump, lump, method_named("rigid"), voxel=voxel)


def test_rigid_stands_outliers_and_partial_overlap(lump, random, truth):
    source = lump[lump[:, 0] < 0.54]
    target = lump[lump[:, 0] > 0.45]
    stray = random.uniform(lump.min(axis=0) - 0.05, lump.max(axis=0) + 0.05, size=(300, 3))
    target = transformed(truth, np.concatenate([target, stray]))
    found = align(source, target, method_named("rigid"))
    degrees, metres = errors(found.transform, truth)
    assert degrees < 2.0
    assert metres < 0.01


def test_common_motion_of_both_clouds_changes_the_result_as_it_must(lump, truth):
    """T_target_source becomes G T G^-1, but for the voxels and boxes, which are along the axes."""
    source, target = lump[::2], transformed(truth, lump[1::2])
    common = rigid(vector_to_matrix(np.array([0.5, 1.0, -0.7])), np.array([3.0, 1.0, -2.0]))
    both = transformed(common, source), transformed(common, target)
    first, second = (
        align(*pair, method_named("rigid"), start="centroids").transform
        for pair in ((source, target), both)
    )
    degrees, metres = errors(inverse(common) @ second @ common, first)
    assert degrees < 0.2
    assert metres < 0.0005


def test_exchanged_clouds_give_the_inverse_motion(lump, truth):
    source, target = lump[:900], transformed(truth, lump[600:])
    there = align(source, target, method_named("rigid")).transform
    back = align(target, source, method_named("rigid")).transform
    degrees, metres = errors(back @ there, np.eye(4))
    assert degrees < 1.0
    assert metres < 0.002


@pytest.mark.parametrize("name", ["open3d_icp", "small_gicp"])
def test_method_without_joints_refuses_a_body_that_has_some(name):
    pytest.importorskip(METHODS[name])
    with pytest.raises(ConfigError, match=f"'{name}' is rigid, .* 'human' has 15 segm"):
        method_named(name).bind(Human(height=1.7).body(1.7))


def test_coarse_to_fine_refuses_what_it_cannot_use(linkage):
    with pytest.raises(ConfigError, match="the template 'linkage' has no surface"):
        method_named("rigid").bind(linkage)
    with pytest.raises(ConfigError, match="shape 'gsog' has no width that could be changed"):
        method_named("{preset: rigid, shape: gsog}")


@pytest.mark.parametrize("name", ["small_gicp", "biocpd", "probreg_cpd"])
def test_missing_library_is_told_with_the_command_that_installs_it(monkeypatch, lump, name):
    def missing(module, *_):
        raise ModuleNotFoundError(module, name=module.partition(".")[0])

    monkeypatch.setattr(importlib, "import_module", missing)
    with pytest.raises(DependencyError, match=r"is not installed; run: pip install"):
        method_named(name).library()
    assert builtins.__import__ is not missing


def test_failure_of_a_library_is_told(monkeypatch, lump):
    method = method_named("open3d_icp")

    def failing(*_):
        raise ValueError("no luck")

    monkeypatch.setattr(type(method), "aligned", failing)
    with pytest.raises(DataError, match="method 'open3d_icp' failed: ValueError: no luck"):
        align(lump, lump, method)


def test_coordinates_of_unit_length_give_the_same_motion(random):
    points = random.normal(size=(10, 3)) + 7.0
    frame = Normalization.around(points, 3.0)
    rotation, shift = vector_to_matrix(np.array([0.2, 0.1, -0.5])), np.array([0.1, 0.2, 0.3])
    inside = frame.normalized(points) @ rotation.T + shift
    outside = transformed(frame.transform(rotation, shift), points)
    np.testing.assert_allclose(frame.normalized(outside), inside)


def test_rotations_of_the_icosahedron_are_a_group_near_every_rotation(random):
    rotations = icosahedral()
    assert rotations.shape == (60, 3, 3)
    np.testing.assert_allclose(np.linalg.det(rotations), 1.0)
    products = (rotations[:, None] @ rotations[None]).reshape(-1, 9)
    distances = np.abs(products[:, None] - rotations.reshape(1, 60, 9)).max(axis=2)
    assert distances.min(axis=1).max() < 1e-6
    some = vector_to_matrix(random.normal(size=(500, 3)) * 2.0)
    cosines = (np.einsum("aij,bij->ab", some, rotations).max(axis=1) - 1.0) / 2.0
    assert np.degrees(np.arccos(cosines.min())) < 45.0


def test_agreement_counts_what_is_near():
    source = np.array([[0.0, 0, 0], [1, 0, 0], [5, 0, 0]])
    found = agreement(source, np.array([[0.0, 0, 0.3], [1, 0, 0.4]]), np.eye(4), 0.5)
    assert found.fitness == pytest.approx(2 / 3)
    assert found.overlap == 1.0
    assert found.inlier_rmse == pytest.approx(np.sqrt((0.09 + 0.16) / 2))
    nothing = agreement(source, source + 100.0, np.eye(4), 0.5)
    assert (nothing.fitness, nothing.overlap) == (0.0, 0.0)
    assert np.isnan(nothing.inlier_rmse)


def test_motion_that_slides_a_surface_is_named(lump, random):
    assert weak_motion(lump) is None
    ball = random.normal(size=(2000, 3))
    ball /= np.linalg.norm(ball, axis=1, keepdims=True)
    assert weak_motion(ball).startswith("a rotation about the direction")
    angles, heights = random.uniform(-np.pi, np.pi, 2000), random.uniform(-9, 9, 2000)
    tube = np.column_stack([np.cos(angles), np.sin(angles), heights])
    assert weak_motion(tube) is not None
