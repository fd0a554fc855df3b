"""Verdicts of frames and tracks, from shares of inliers and coverage."""

from dataclasses import replace

import numpy as np
import pytest

from regkit.body import BodyFit
from regkit.geometry.rigid import rigid
from regkit.interfaces import Start
from regkit.system.errors import DataError
from regkit.system.notes import RegkitWarning
from regkit.tracking import Track, TrackVerdict, Verdict
from regkit.tracking.extent import check_extent, extent_of, tell_bound
from regkit_plugins.templates.hand import Hand
from regkit_plugins.templates.human import Human

F, D, L, N = Verdict.FOUND, Verdict.DOUBTFUL, Verdict.LOST, Verdict.NO_DATA
SHARES = {F: 0.95, D: 0.6, L: 0.2, N: np.nan}


def track_with(*verdicts: Verdict) -> Track:
    count = len(verdicts)
    nothing, shares = np.zeros(count), np.array([SHARES[one] for one in verdicts])
    return Track(
        numbers=np.arange(float(count)),
        times=np.arange(float(count)),
        root=np.tile(np.eye(4), (count, 1, 1)),
        balls=np.zeros((count, 0, 4)),
        hinges=np.zeros((count, 0)),
        markers=np.zeros((count, 0, 3)),
        surface_distances=nothing,
        inlier_shares=shares,
        coverages=np.where(np.isnan(shares), np.nan, 1.0),
        misfits=np.where(np.isnan(shares), np.nan, 0.3),
        reliefs=np.where(np.isnan(shares), np.nan, 1.0),
        supports=np.ones((count, 0)),
        points=np.array([0.0 if one is N else 50.0 for one in verdicts]),
        energies=nothing,
        evaluations=nothing,
        converged=nothing,
        seconds=nothing,
        preprocessing=nothing,
    )


def test_frame_is_judged_by_the_worse_of_both_shares():
    track = track_with(F, D, L, N)
    assert track.verdicts == (F, D, L, N)
    swapped = replace(track, inlier_shares=track.coverages, coverages=track.inlier_shares)
    assert swapped.verdicts == (F, D, L, N)


def test_body_without_a_surface_raises_no_doubt():
    unknown = np.full(2, np.nan)
    track = replace(
        track_with(F, F), inlier_shares=unknown, coverages=unknown, misfits=unknown, reliefs=unknown
    )
    assert track.verdicts == (F, F)


@pytest.mark.parametrize(
    ("frames", "verdict"),
    [
        ([F] * 20, F),
        ([F] * 19 + [N], F),
        ([F] * 19 + [D], D),
        ([D] + [F] * 19, F),
        ([D] * 4 + [F] * 16, D),
        ([F] * 10 + [L] + [F] * 9, D),
        ([F] * 19 + [L], L),
        ([F] * 18 + [L, N], L),
        ([L] * 11 + [F] * 9, L),
        ([F] * 10 + [N] * 10, D),
        ([N] * 5, L),
        ([F], F),
        ([D], D),
        ([L], L),
    ],
)
def test_track_is_judged_by_its_frames(frames, verdict):
    judged = TrackVerdict.of(track_with(*frames))
    assert judged.verdict is verdict
    assert bool(judged.reason) == (verdict is not F or N in frames)


def test_rigid_object_is_judged_by_its_inliers_alone():
    """Its far side is never seen."""
    unknown = np.full(3, np.nan)
    track = replace(track_with(F, D, L), coverages=unknown, misfits=unknown, reliefs=unknown)
    assert track.verdicts == (F, D, L)
    assert "nan" not in TrackVerdict.of(track).reason


def test_wall_is_no_body():
    track = replace(track_with(F, F), reliefs=np.array([1.0, 0.1]))
    assert track.verdicts == (F, L)
    assert "flat" in TrackVerdict.of(track).reason


def test_reason_names_the_worst_frame_by_its_number():
    track = replace(track_with(F, L, F), numbers=np.array([5.0, 7.0, 9.0]))
    assert "in frame 7 " in TrackVerdict.of(track).reason


def surface_of(body, pose) -> np.ndarray:
    axes = body.capsules.axis_points(0.02)
    return axes.place(body.place(pose).transforms) - axes.radii[:, None] * [0.0, 0.0, 1.0]


@pytest.mark.parametrize("template", [Human(height=1.7), Hand(side="right", length=0.18)])
def test_fit_falls_with_wrong_places_wrong_sizes_and_missing_parts(template):
    body = template.body(template.given_size())
    pose = body.skeleton.rest(rigid(np.diag([1.0, -1.0, -1.0]), np.array([0.0, 0.0, 2.0])))
    points = surface_of(body, pose)
    whole = BodyFit.of(body, pose, points)
    assert min(whole.inlier_share, whole.coverage) > 0.95
    assert whole.distance < 0.1 * body.size
    assert whole.relief > 0.4
    assert BodyFit.of(body, pose, points * [1.0, 1.0, 0.0] + [0.0, 0.0, 2.0]).relief < 1e-6
    shifted = BodyFit.of(body, pose, points + np.array([0.3 * body.size, 0.0, 0.0]))
    assert min(shifted.inlier_share, shifted.coverage) < 0.5
    halved = BodyFit.of(body, pose, points[points[:, 1] > np.median(points[:, 1])])
    assert halved.inlier_share > 0.95
    assert halved.coverage < 0.75
    centre = points.mean(axis=0)
    doubled = BodyFit.of(body, pose, centre + 2.0 * (points - centre))
    assert min(doubled.inlier_share, doubled.coverage) < 0.75


@pytest.mark.parametrize("template", [Human(), Hand(side="right", forearm=False)])
def test_extent_of_the_data_is_compared_with_the_template(template):
    size = template.description().size.value
    body = template.body(size)
    points = surface_of(body, body.skeleton.rest())
    check_extent(points, template, place="here")
    for factor in (0.35, 3.0):
        with pytest.warns(RegkitWarning, match="here: the points are spread over"):
            check_extent(factor * points, template, place="here")
    for factor in (0.001, 1000.0):
        with pytest.raises(DataError, match="here: the points are spread over"):
            check_extent(factor * points, template, place="here")


def test_extent_with_the_parts_that_the_data_may_show_is_usual():
    body = Hand(forearm=True).body(0.22)
    points = surface_of(body, body.skeleton.rest())
    check_extent(points, Hand(), place="here")
    with pytest.warns(RegkitWarning, match="here: the points are spread over"):
        check_extent(3.0 * points, Hand(), place="here")
    with pytest.warns(RegkitWarning, match="here: the points are spread over"):
        check_extent(points, Hand(forearm=False), place="here")


def test_size_at_an_end_of_the_range_is_told():
    low, high = Human().description().size.range
    for size in (low, high):
        with pytest.warns(RegkitWarning, match="here: .*at an end of"):
            tell_bound(size, Human(), place="here")
    tell_bound(0.5 * (low + high), Human(), place="here")
    tell_bound(1.7, Human(height=1.7), place="here")


def test_extent_does_not_depend_on_direction_or_stray_points(random):
    rod = np.outer(np.linspace(-1.0, 1.0, 1000), [0.6, 0.0, 0.8])
    stray = np.concatenate([rod, 50.0 * random.normal(size=(5, 3))])
    assert extent_of(rod) == pytest.approx(2.0, rel=0.05)
    assert extent_of(stray) == pytest.approx(2.0, rel=0.1)


@pytest.mark.parametrize(
    ("start", "frames", "verdict"),
    [(F, (F, F), F), (D, (F, F), D), (L, (F, F), L), (D, (F, L), L), (L, (F, D), L)],
)
def test_track_is_no_surer_than_its_start(start, frames, verdict):
    body = Human(height=1.7).body(1.7)
    begun = Start(body, body.skeleton.rest(), start, "a cupboard")
    judged = TrackVerdict.of(track_with(*frames), start=begun)
    assert judged.verdict is verdict
    assert ("a cupboard" in judged.reason) == (start is not F)


def test_segments_with_little_data_are_counted_in_the_frames_that_have_some():
    supports = np.array([[0.9, 0.1, np.nan], [0.8, 0.9, np.nan], [0.0, 0.0, 0.0]])
    track = replace(track_with(F, F, N), supports=supports)
    assert track.weakly_seen.tolist() == [0.0, 0.5, 0.0]
    assert replace(track_with(N), supports=np.zeros((1, 2))).weakly_seen.tolist() == [0.0, 0.0]
