"""Figures of tracks whose errors are known."""

from dataclasses import replace

import numpy as np
import pytest

from regkit.body import Body
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.metrics import (
    METRICS,
    PCK_FRACTION,
    Measure,
    in_words,
    joint_errors,
    mean_of,
    tell_unmatched,
)
from regkit.metrics import measured as measured_from
from regkit.observation import Truth
from regkit.skeleton import Pose
from regkit.system.errors import ConfigError, DataError
from regkit.system.notes import RegkitWarning
from regkit.tracking import Track

FRAMES = 12
FPS = 10.0


def measured(track: Track, body: Body, truth: Truth | None, joints: dict[str, str]) -> Measure:
    errors = None if truth is None else joint_errors(track, body, truth, joints)
    return measured_from(track, body, errors, FPS)


def track_of(body: Body, poses: list[Pose]) -> Track:
    placements = [body.place(pose) for pose in poses]
    return Track(
        numbers=np.arange(float(len(poses))),
        times=np.arange(len(poses)) / FPS,
        root=np.array([pose.root for pose in poses]),
        balls=np.array([pose.balls for pose in poses]),
        hinges=np.array([pose.hinges for pose in poses]),
        markers=np.array([body.markers.place(placed.transforms) for placed in placements]),
        surface_distances=np.linspace(0.001, 0.003, len(poses)),
        energies=np.zeros(len(poses)),
        inlier_shares=np.ones(len(poses)),
        coverages=np.ones(len(poses)),
        misfits=np.zeros(len(poses)),
        reliefs=np.ones(len(poses)),
        supports=np.ones((len(poses), len(body.skeleton.names))),
        points=np.full(len(poses), 100.0),
        evaluations=np.arange(1.0, len(poses) + 1.0),
        converged=np.ones(len(poses)),
        seconds=np.full(len(poses), 0.05),
        preprocessing=np.full(len(poses), 0.01),
    )


def wandering(body: Body, random: np.random.Generator, frames: int = FRAMES) -> list[Pose]:
    poses = [body.skeleton.rest()]
    while len(poses) < frames:
        step = 0.2 * random.normal(size=body.skeleton.dofs)
        poses.append(body.skeleton.retract(poses[-1], step))
    return poses


@pytest.fixture
def track(linkage, random) -> Track:
    return track_of(linkage, wandering(linkage, random))


def perfect(body: Body, track: Track) -> Truth:
    return Truth(body.markers.names, track.markers.copy())


def displaced(body: Body, track: Track, offsets: np.ndarray) -> Truth:
    """Markers that are elsewhere in their segments than the body believes, by (M, 3) [m]."""
    transforms = [body.place(track.pose(index)).transforms for index in range(len(track.markers))]
    rotations = np.array(transforms)[:, body.markers.segments, :3, :3]
    return Truth(body.markers.names, track.markers + np.einsum("tmab,mb->tma", rotations, offsets))


def test_perfect_track_has_no_error(linkage, track):
    found = measured(track, linkage, perfect(linkage, track), {})
    assert found.joint_error_raw_cm == 0.0
    assert found.joint_error_adjusted_cm == pytest.approx(0.0, abs=1e-12)
    assert found.within_10cm_percent == found.within_10cm_adjusted_percent == 100.0
    assert found.lost_frames == 0
    assert found.frames == FRAMES


def test_figures_without_truth_are_those_of_the_run(linkage, track):
    found = measured(track, linkage, None, {})
    assert found.joint_error_raw_cm is found.joint_error_adjusted_cm is None
    assert found.within_10cm_percent is found.within_10cm_adjusted_percent is None
    assert found.lost_frames is None
    assert found.frames == FRAMES
    assert found.surface_distance_mm == pytest.approx(2.0)
    assert found.evaluations_per_frame == pytest.approx((1 + FRAMES) / 2)
    assert found.fps == pytest.approx(20.0)
    assert found.preprocessing_ms == pytest.approx(10.0)
    assert found.registering_ms == pytest.approx(40.0)


def test_constant_displacement_in_a_segment_vanishes_when_adjusted(linkage, track):
    offsets = np.array([[0.02, 0.0, 0.01], [0.0, -0.15, 0.0], [0.03, 0.04, 0.0]])
    found = measured(track, linkage, displaced(linkage, track, offsets), {})
    lengths = np.linalg.norm(offsets, axis=1)
    assert found.joint_error_raw_cm == pytest.approx(100.0 * lengths.mean())
    assert found.joint_error_adjusted_cm == pytest.approx(0.0, abs=1e-9)
    assert found.within_10cm_percent == pytest.approx(100.0 * (lengths < PCK_FRACTION).mean())
    assert found.within_10cm_adjusted_percent == 100.0


def test_constant_displacement_in_the_world_does_not_vanish(linkage, track):
    """The adjustment is the segment's, which turns; it must not hide a lag of the whole body."""
    truth = Truth(linkage.markers.names, track.markers + np.array([0.05, 0.0, 0.0]))
    found = measured(track, linkage, truth, {})
    assert found.joint_error_raw_cm == pytest.approx(5.0)
    assert found.joint_error_adjusted_cm > 0.5


def test_errors_do_not_depend_on_the_frame_of_the_camera(linkage, track, random):
    truth = Truth(
        linkage.markers.names, track.markers + 0.05 * random.normal(size=track.markers.shape)
    )
    motion = rigid(vector_to_matrix(random.normal(size=3)), random.normal(size=3))
    moved_poses = [
        Pose(motion @ track.root[index], track.balls[index], track.hinges[index])
        for index in range(FRAMES)
    ]
    moved_truth = Truth(truth.joints, truth.positions @ motion[:3, :3].T + motion[:3, 3])
    here = measured(track, linkage, truth, {}).to_dict()
    there = measured(track_of(linkage, moved_poses), linkage, moved_truth, {}).to_dict()
    assert here["joint_error_adjusted_cm"] > 1.0
    assert there == pytest.approx(here)


def test_adjustment_is_not_fitted_on_the_frames_that_it_is_measured_on(linkage, random):
    """Of pure noise nothing is constant: adjusted by the noise of other frames, errors grow."""
    track = track_of(linkage, wandering(linkage, random, frames=4))
    noises = random.normal(scale=0.03, size=(30, *track.markers.shape))
    found = [
        measured(track, linkage, Truth(linkage.markers.names, track.markers + noise), {})
        for noise in noises
    ]
    raw = np.mean([one.joint_error_raw_cm for one in found])
    adjusted = np.mean([one.joint_error_adjusted_cm for one in found])
    # Each displacement is the mean of two frames' noise.
    assert adjusted / raw == pytest.approx(np.sqrt(1.5), rel=0.1)


def test_adjustment_of_even_frames_is_fitted_on_odd_ones(linkage, random):
    """Of four frames the first is 4 cm off: it stays so, and moves the odd ones by its half."""
    track = track_of(linkage, wandering(linkage, random, frames=4))
    truth = perfect(linkage, track)
    truth.positions[0, :, 0] += 0.04
    found = measured(track, linkage, truth, {})
    assert found.joint_error_raw_cm == pytest.approx(1.0)
    assert found.joint_error_adjusted_cm == pytest.approx((4.0 + 2.0 + 0.0 + 2.0) / 4)


def test_frame_is_lost_when_less_than_half_of_its_joints_are_near(linkage, track):
    """Of the three markers two are far off in three frames, and one in another."""
    truth = perfect(linkage, track)
    truth.positions[[2, 5, 7], :2] += 1.0
    truth.positions[9, 0] += 1.0
    found = measured(track, linkage, truth, {})
    assert found.lost_frames == 3
    assert found.within_10cm_percent == pytest.approx(100.0 * (1.0 - 7 / (3 * FRAMES)))


def test_time_to_recover_is_the_mean_length_of_what_was_lost(linkage, track):
    """Lost in frames 2 to 4 and again in the last one, at ten frames in a second."""
    truth = perfect(linkage, track)
    truth.positions[[2, 3, 4, FRAMES - 1]] += 1.0
    found = measured(track, linkage, truth, {})
    assert found.lost_frames == 4
    assert found.recovery_s == pytest.approx(0.2)
    assert found.lost_at_end == 1


def test_body_that_was_never_lost_has_no_time_to_recover(linkage, track):
    found = measured(track, linkage, perfect(linkage, track), {})
    assert found.recovery_s is None
    assert found.lost_at_end == 0


def test_frame_without_a_known_joint_is_not_lost(linkage, track):
    truth = perfect(linkage, track)
    truth.positions[FRAMES - 1] = np.nan
    found = measured(track, linkage, truth, {})
    assert found.lost_frames == found.lost_at_end == 0


def test_area_is_that_under_the_curve_of_the_shares_within_thresholds(linkage, track, random):
    """The exact area is the limit of trapezia under the curve."""
    noise = random.normal(scale=0.05, size=track.markers.shape)
    truth = Truth(linkage.markers.names, track.markers + noise)
    found = measured(track, linkage, truth, {})
    distances = np.linalg.norm(noise, axis=2)
    thresholds = np.linspace(0.0, 2.0 * PCK_FRACTION * linkage.size, 20001)
    shares = [(distances < threshold).mean() for threshold in thresholds]
    expected = 100.0 * np.trapezoid(shares, thresholds) / thresholds[-1]
    assert found.auc_percent == pytest.approx(expected, abs=0.01)
    assert measured(track, linkage, perfect(linkage, track), {}).auc_percent == 100.0


def test_joint_that_was_not_seen_does_not_count(linkage, track):
    truth = perfect(linkage, track)
    truth.positions[:] += 0.01
    expected = measured(track, linkage, truth, {})
    truth.positions[3] = np.nan
    truth.positions[4:, 1] = np.nan
    found = measured(track, linkage, truth, {})
    assert found.joint_error_raw_cm == pytest.approx(expected.joint_error_raw_cm)
    assert found.within_10cm_percent == 100.0
    assert found.lost_frames == 0
    errors = joint_errors(track, linkage, truth, {}).raw
    assert np.isnan(errors[3]).all()
    assert np.isnan(errors).sum() == 3 + (FRAMES - 4)


def test_truth_that_was_never_seen_gives_no_figure(linkage, track):
    truth = Truth(linkage.markers.names, np.full(track.markers.shape, np.nan))
    found = measured(track, linkage, truth, {})
    assert found.joint_error_raw_cm is found.joint_error_adjusted_cm is None
    assert found.within_10cm_percent is found.within_10cm_adjusted_percent is None


def test_single_frame_has_no_adjusted_error(linkage, random):
    track = track_of(linkage, wandering(linkage, random, frames=1))
    found = measured(track, linkage, perfect(linkage, track), {})
    assert found.joint_error_raw_cm == 0.0
    assert found.joint_error_adjusted_cm is None
    assert found.within_10cm_adjusted_percent is None


def test_joints_are_matched_by_name_in_any_order(linkage, track):
    order = [2, 0, 1]
    names = tuple(linkage.markers.names[index] for index in order)
    truth = Truth((*names, "nose"), np.full((FRAMES, 4, 3), 9.0))
    truth.positions[:, :3] = track.markers[:, order]
    assert measured(track, linkage, truth, {}).joint_error_raw_cm == 0.0


def test_joints_of_other_names_are_mapped(linkage, track):
    truth = Truth(("toe", "nose"), np.zeros((FRAMES, 2, 3)))
    truth.positions[:, 0] = track.markers[:, linkage.markers.names.index("foot")]
    assert measured(track, linkage, truth, {"toe": "foot"}).joint_error_raw_cm == 0.0
    assert measured(track, linkage, truth, {"nose": "foot"}).joint_error_raw_cm > 0.0


@pytest.mark.parametrize(
    ("joints", "expected"),
    [
        ({}, ["dataset.joints: ", "toe, nose", "'linkage'", "dataset.compared=false"]),
        ({"toes": "foot"}, ["dataset.joints: ", "'toes'", "did you mean 'toe'?"]),
        ({"toe": "foots"}, ["dataset.joints.toe: ", "'foots'", "did you mean 'foot'?"]),
    ],
)
def test_joints_that_do_not_match_are_told(linkage, track, joints, expected):
    truth = Truth(("toe", "nose"), np.zeros((FRAMES, 2, 3)))
    with pytest.raises(ConfigError) as caught:
        measured(track, linkage, truth, joints)
    for part in expected:
        assert part in str(caught.value)


def test_limit_violation_is_the_mean_of_the_largest(linkage):
    """The forearm's hinge may bend to 140 degrees; in every other frame it bends 30 too far."""
    bones = linkage.skeleton
    step = np.zeros(bones.dofs)
    step[bones.joint_dofs["forearm"]] = np.radians(170.0)
    bent = bones.retract(bones.rest(), step)
    track = track_of(linkage, [bones.rest(), bent, bones.rest(), bent])
    found = measured(track, linkage, None, {})
    assert found.limit_violation_deg == pytest.approx(15.0)


@pytest.mark.parametrize("factor", [1000.0, 0.01])
def test_reference_in_another_unit_is_refused(linkage, track, factor):
    truth = Truth(linkage.markers.names, factor * track.markers)
    with pytest.raises(DataError, match="in metres"):
        joint_errors(track, linkage, truth, {})


def test_reference_joints_that_match_no_marker_are_told(linkage, track):
    names = ("unheard_of", *linkage.markers.names[1:])
    with pytest.warns(RegkitWarning, match="there: .*unheard_of"):
        tell_unmatched(linkage, Truth(names, track.markers), {}, place="there")
    tell_unmatched(linkage, perfect(linkage, track), {}, place="there")


def test_frames_without_data_count_for_no_mean(linkage, track):
    unseen = replace(
        track,
        points=np.where(np.arange(FRAMES) < 2, 0.0, 100.0),
        surface_distances=np.where(np.arange(FRAMES) < 2, np.nan, 0.002),
        inlier_shares=np.where(np.arange(FRAMES) < 2, np.nan, 1.0),
        seconds=np.where(np.arange(FRAMES) < 2, 9.0, 0.05),
    )
    found = measured(unseen, linkage, None, {})
    assert found.frames_without_data == 2
    assert found.found_percent == found.inlier_percent == 100.0
    assert found.surface_distance_mm == pytest.approx(2.0)
    assert found.fps == pytest.approx(20.0)
    assert "2 of 12 frames have no data" in found.reason


def test_body_without_a_surface_has_no_surface_distance(linkage, track):
    track = replace(track, surface_distances=np.full(FRAMES, np.nan))
    assert measured(track, linkage, None, {}).surface_distance_mm is None


def figures(**known: float | None) -> Measure:
    return Measure(**{name: known.get(name, 1.0) for name in METRICS})


def test_mean_is_taken_figure_by_figure():
    mean = mean_of([figures(fps=10.0, frames=3), figures(fps=30.0, frames=4)])
    assert mean.fps == 20.0
    assert mean.frames == 3.5
    assert mean.joint_error_raw_cm == 1.0


def test_mean_is_none_where_a_recording_lacks_the_figure():
    mean = mean_of([figures(), figures(joint_error_raw_cm=None)])
    assert mean.joint_error_raw_cm is None
    assert mean.fps == 1.0


def test_mean_time_to_recover_is_that_of_the_recordings_with_losses():
    assert mean_of([figures(recovery_s=None), figures(recovery_s=3.0)]).recovery_s == 3.0
    assert mean_of([figures(recovery_s=None)]).recovery_s is None


def test_mean_of_nothing_is_none():
    assert set(mean_of([]).to_dict().values()) == {None}


def test_a_great_speed_is_told_without_a_power_of_ten():
    assert in_words(1096.1) == "1096 frames per second"
    assert in_words(3.456) == "3.46 frames per second"
    assert in_words(None) == "-"
