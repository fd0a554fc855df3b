"""The covariance of an alignment holds its errors, and shows what the data do not determine."""

import numpy as np
import pytest

from regkit.alignment import align
from regkit.alignment.uncertainty import alignment_covariance
from regkit.clouds.agreement import Agreements
from regkit.clouds.tree import Tree
from regkit.geometry.rigid import rigid, transformed
from regkit.geometry.rotation import from_matrix, to_vector, vector_to_matrix
from regkit.interfaces import Method


def box(random, count=1500):
    """Points on an open box, whose sides have three different lengths [m]."""
    points = random.uniform(-1.0, 1.0, size=(count, 3))
    points[np.arange(count), random.integers(3, size=count)] = -1.0
    return points * [0.3, 0.2, 0.1]


def covariance_of(source, target, transform):
    agreement = Agreements.of(source, target).after(transform, 0.05)
    return alignment_covariance(source, Tree.of(target), transform, agreement)


def test_intervals_hold_the_errors_of_noise(random):
    method = Method.parse({"preset": "rigid"}, place="test", field="method")
    inside = []
    for _ in range(8):
        cloud = box(random, 500)
        truth = rigid(vector_to_matrix(0.1 * random.normal(size=3)), 0.05 * random.normal(size=3))
        source = cloud + 0.003 * random.normal(size=cloud.shape)
        target = transformed(truth, cloud) + 0.003 * random.normal(size=cloud.shape)
        found = align(source, target, method, voxel=0.0)
        centre = source.mean(axis=0)[None]
        shift = transformed(truth, centre) - transformed(found.transform, centre)
        turned = to_vector(from_matrix(truth[:3, :3] @ found.transform[:3, :3].T))
        error = np.abs(np.concatenate([shift[0], turned]))
        inside.append(error < 1.645 * found.deviations)
        assert (found.deviations < 0.02).all()
    assert np.mean(inside) > 0.75


def test_plane_slides_along_itself_and_turns_in_itself(random):
    flat = random.uniform(-0.5, 0.5, size=(800, 3)) * [1.0, 1.0, 0.0]
    noisy = flat + 0.002 * random.normal(size=flat.shape)
    deviations = np.sqrt(np.diag(covariance_of(noisy, flat, np.eye(4))))
    assert deviations[:2].min() > 20.0 * deviations[2]
    assert deviations[5] > 20.0 * deviations[3:5].max()


def test_covariance_turns_with_the_target(random):
    cloud = box(random)
    noisy = cloud + 0.003 * random.normal(size=cloud.shape)
    before = covariance_of(noisy, cloud, np.eye(4))
    turn = vector_to_matrix(np.array([0.4, -0.3, 0.8]))
    truth = rigid(turn, np.array([0.1, 0.2, 0.3]))
    after = covariance_of(noisy, transformed(truth, cloud), truth)
    wide = np.kron(np.eye(2), turn)
    np.testing.assert_allclose(after, wide @ before @ wide.T, rtol=1e-6, atol=1e-12)


def test_clouds_apart_are_as_wide_as_the_source(random):
    cloud = box(random)
    covariance = covariance_of(cloud, cloud + 100.0, np.eye(4))
    size = np.linalg.norm(np.ptp(cloud, axis=0))
    assert np.sqrt(np.diag(covariance))[:3] == pytest.approx(size)
