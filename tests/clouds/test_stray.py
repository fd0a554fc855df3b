"""Stray points: told by a gap in the cloud's own distribution of densities."""

import numpy as np
import pytest

from regkit.clouds import surface_downsampled, voxel_downsampled, without_stray
from regkit.interfaces import Preprocessor
from regkit.observation import Frame


def surface(random, count):
    """Points on a bumpy ball."""
    unit = random.normal(size=(count, 3))
    unit /= np.linalg.norm(unit, axis=1, keepdims=True)
    return (1.0 + 0.2 * np.sin(3.0 * unit[:, :1])) * unit * [1.0, 0.8, 0.6]


def spread(random, count):
    """Points spread over its box."""
    return random.uniform(-1.2, 1.2, size=(count, 3)) * [1.0, 0.8, 0.6]


@pytest.mark.parametrize("share", [0.05, 0.2, 0.4])
@pytest.mark.parametrize("count", [5000, 40_000])
def test_points_spread_over_the_box_are_left_out(random, count, share):
    good, bad = surface(random, count), spread(random, round(share / (1.0 - share) * count))
    cloud = random.permutation(np.concatenate([good, bad]))
    kept = without_stray(cloud)
    rows = {row.tobytes() for row in kept}
    assert np.mean([row.tobytes() in rows for row in good]) > 0.98
    # Those that are near the surface by chance remain.
    far = bad[np.abs(np.linalg.norm(bad / [1.0, 0.8, 0.6], axis=1) - 1.0) > 0.4]
    assert np.mean([row.tobytes() in rows for row in far]) < 0.2


def test_clouds_without_stray_points_keep_all(random):
    near_and_far = surface(random, 20_000) * random.uniform(size=(20_000, 1)) ** 2
    volume = random.normal(size=(5000, 3))
    grid = np.stack(np.meshgrid(*[np.arange(12.0)] * 3), axis=-1).reshape(-1, 3)
    street = np.concatenate([volume * [30.0, 30.0, 0.02], volume * [1.0, 1.0, 0.02]])
    for cloud in (surface(random, 300), near_and_far, volume, grid, street, volume[:10]):
        assert without_stray(cloud) is cloud


def test_evenly_thin_clouds_are_downsampled_as_ever(random):
    cloud = surface(random, 3000)
    for voxel in (1e-3, 0.05, 0.3):
        np.testing.assert_array_equal(
            surface_downsampled(cloud, voxel), voxel_downsampled(cloud, voxel)
        )


@pytest.mark.parametrize("choice", [{"kind": "points", "voxel": 0.08}, {"kind": "octree"}])
def test_preprocessors_leave_out_stray_points(random, choice):
    good, bad = surface(random, 8000), spread(random, 1500)
    both = Frame(points=np.concatenate([good, bad]))
    counts = {}
    for drop in (False, True):
        chosen = Preprocessor.parse(
            {**choice, "drop_stray": drop}, place="the test", field="preprocessor"
        )
        points = chosen.preprocess(both).points
        radii = np.linalg.norm(points / [1.0, 0.8, 0.6], axis=1)
        counts[drop] = int((np.abs(radii - 1.0) > 0.35).sum()), len(points)
    assert counts[True][0] < 0.3 * counts[False][0]
    assert counts[True][1] > 300
