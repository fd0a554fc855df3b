"""Intervals of markers hold nine of ten true joints, if the covariance is the true one."""

from dataclasses import replace

import numpy as np
import pytest
from made_tracks import made_track

from regkit.metrics import joint_errors, measured
from regkit.observation import Truth
from regkit.skeleton import Pose
from regkit.tracking import Track

FRAMES = 400


@pytest.fixture
def drawn(linkage, random):
    """A track whose poses are off by steps of its covariances, and the true joints."""
    bones = linkage.skeleton
    right = made_track(linkage, FRAMES)
    root = random.normal(size=(bones.dofs, bones.dofs))
    covariance = 1e-5 * root @ root.T
    steps = random.multivariate_normal(np.zeros(bones.dofs), covariance, size=FRAMES)
    off = [bones.retract(right.pose(index), step) for index, step in enumerate(steps)]
    track = replace(
        right,
        root=np.array([pose.root for pose in off]),
        balls=np.array([pose.balls for pose in off]),
        hinges=np.array([pose.hinges for pose in off]),
        markers=np.array([linkage.markers.place(linkage.place(pose).transforms) for pose in off]),
        covariances=np.tile(covariance, (FRAMES, 1, 1)),
    )
    return track, Truth(linkage.markers.names, right.markers)


def test_intervals_hold_nine_of_ten_joints(linkage, drawn):
    track, truth = drawn
    errors = joint_errors(track, linkage, truth, {})
    assert np.nanmean(errors.covered) == pytest.approx(0.9, abs=0.025)
    assert (errors.raw < errors.expected()[:, None]).mean() == pytest.approx(0.9, abs=0.1)
    # Of half the deviation 59 % are within, of twice it all.
    for factor, held in ((0.5, 0.589), (2.0, 0.999)):
        other = replace(track, covariances=factor**2 * track.covariances)
        covered = joint_errors(other, linkage, truth, {}).covered
        assert np.nanmean(covered) == pytest.approx(held, abs=0.03)
    measure = measured(track, linkage, errors, 30.0)
    assert measure.interval_coverage_percent == pytest.approx(100.0 * np.nanmean(errors.covered))
    sides = track.marker_deviations(linkage)
    expected = 100.0 * np.sqrt((sides**2).mean(axis=2)).mean()
    assert measure.marker_deviation_cm == pytest.approx(expected)


def test_marker_covariance_is_that_of_the_placed_markers(linkage, drawn, random):
    track, _ = drawn
    bones, pose = linkage.skeleton, track.pose(3)
    steps = random.multivariate_normal(np.zeros(bones.dofs), track.covariances[3], size=4000)
    places = np.array([
        linkage.markers.place(linkage.place(bones.retract(pose, step)).transforms)
        for step in steps
    ])  # fmt: skip
    told = track.marker_covariances(linkage)[3]
    for marker in range(len(linkage.markers.names)):
        scale = np.abs(told[marker]).max()
        measured_here = np.cov(places[:, marker].T)
        np.testing.assert_allclose(measured_here, told[marker], atol=0.12 * scale)


def test_frames_without_data_have_no_interval_and_others_keep_theirs(linkage, drawn):
    track, truth = drawn
    unknown = track.covariances.copy()
    unknown[10:20] = np.nan
    errors = joint_errors(replace(track, covariances=unknown), linkage, truth, {})
    assert np.isnan(errors.covered[10:20]).all()
    assert np.isfinite(errors.covered[20:]).all()
    assert np.isnan(errors.expected()[10:20]).all()


def test_track_of_a_method_that_does_not_know_has_no_covariance(linkage):
    track = made_track(linkage, 6)
    arrays = track.named_arrays(linkage)
    rows = {name: arrays[name] for name in Track.layout(linkage) if name in arrays}
    rows |= {"covariances": np.full((6, 15, 15), np.nan), "effective_points": np.full(6, np.nan)}
    assert Track.of(rows).covariances is None
    assert Track.of(rows)[2:4].marker_deviations(linkage) is None
    assert isinstance(Track.of(rows).pose(0), Pose)
