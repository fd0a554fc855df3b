"""Tracking with several cameras: accuracy, absent cameras, clocks, segmentation and starts."""

import warnings
from functools import cache

import numpy as np
import pytest
from around import CAMERA, around, facing, view_of

import regkit
from regkit.geometry.rigid import transformed
from regkit.observation import Frame, View
from regkit.system.errors import RegkitError
from regkit_plugins.templates.human import Human

TEMPLATE = Human(height=1.7)
TURN = 1.4
SETTINGS = {"segmentation": [], "preprocessor": {"kind": "points", "voxel": 0.06, "sigma": 0.02}}
COUNT = 36


@cache
def motion():
    """A body that swings its limbs in front of the first camera."""
    body = TEMPLATE.body(1.7)
    step = 0.25 * np.random.default_rng(5).normal(size=(2, body.skeleton.dofs))
    step[:, :3] *= 0.3
    start = facing(body, turn=0.2)
    poses = []
    for frame in range(COUNT):
        swing = np.sin(0.35 * frame) * step[0] + (1.0 - np.cos(0.27 * frame)) * step[1]
        poses.append(body.skeleton.limits.projected(body.skeleton.retract(start, swing)))
    return body, poses


@cache
def views():
    """What both cameras see in each frame."""
    body, poses = motion()
    beside = around(facing(body).root[:3, 3], TURN)
    return [
        (view_of(body, pose, np.eye(4), "front"), view_of(body, pose, beside, "side"))
        for pose in poses
    ]


def error_of(track, poses):
    body, _ = motion()
    true = np.array([body.markers.place(body.place(pose).transforms) for pose in poses])
    return float(np.linalg.norm(track.markers - true, axis=2).mean())


def tracked(frames, **more):
    _, poses = motion()
    return regkit.track(frames, TEMPLATE, **{**SETTINGS, "start": poses[0], **more})


def test_two_cameras_are_better_than_one():
    _, poses = motion()
    both = tracked([Frame.of_views(one) for one in views()[:12]])
    alone = tracked([one[0].data for one in views()[:12]])
    assert error_of(both, poses[:12]) < 0.8 * error_of(alone, poses[:12])
    assert both.verdict == "found"


def test_stopped_camera_leaves_the_other():
    _, poses = motion()
    frames = [Frame.of_views(one if at < 6 else one[:1]) for at, one in enumerate(views()[:12])]
    found = tracked(frames)
    alone = tracked([one[0].data for one in views()[:12]])
    assert error_of(found, poses[:12]) < 1.05 * error_of(alone, poses[:12])
    counts = found.track.points
    assert counts[5] > 1.4 * counts[6]


def test_wrong_clock_is_told_and_no_worse_than_without_the_camera():
    _, poses = motion()
    pairs = zip(views(), views()[2:], strict=False)
    late = [Frame.of_views((now[0], then[1])) for now, then in pairs]
    poses = poses[: len(late)]
    with pytest.warns(regkit.RegkitWarning, match="clock of camera 'side' is about .* ms behind"):
        found = tracked(late)
    alone = tracked([one[0].data for one in views()[: len(late)]])
    assert error_of(found, poses) <= error_of(alone, poses) + 1e-9


def test_right_clocks_are_not_told():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tracked([Frame.of_views(one) for one in views()[:30]])


def test_camera_that_sees_nothing_is_left_out():
    _, poses = motion()
    blind = View("blind", np.eye(4), Frame(np.zeros((0, 3))))
    found = tracked([Frame.of_views((*one[:1], blind)) for one in views()[:3]])
    alone = tracked([one[0].data for one in views()[:3]])
    np.testing.assert_array_equal(found.markers, alone.markers)
    assert error_of(found, poses[:3]) < 0.1


def test_start_is_sought_in_all_views():
    _, poses = motion()
    # The first camera sees the body from behind; the second one sees its front.
    front, side = views()[0]
    behind = view_of(motion()[0], poses[0], around(facing(motion()[0]).root[:3, 3], 3.0), "behind")
    frame = Frame.of_views((behind, front, side))
    found = regkit.register(
        frame, TEMPLATE, start={"kind": "exemplars", "exemplars": 2000}, **SETTINGS
    )
    body, _ = motion()
    true = body.markers.place(body.place(poses[0]).transforms)
    assert np.linalg.norm(found.markers - true, axis=1).mean() < 0.12


def test_each_view_is_segmented_in_its_own_frame():
    wall = np.stack(np.meshgrid(np.linspace(-2, 2, 40), np.linspace(-1.5, 1.5, 30), [4.5]), -1)
    wall = wall.reshape(-1, 3)
    frames = [
        Frame.of_views([
            View(view.name, view.T_world_camera, Frame(np.concatenate([view.data.points, wall])))
            for view in one
        ])
        for one in views()[:4]
    ]  # fmt: skip
    shown = regkit.preview(frames, TEMPLATE, segmentation=["planes"], count=2)
    assert shown.steps == ("planes",)
    for frame in shown.frames:
        assert frame.counts[0] >= 2 * len(wall)
        assert len(frame.left.views) == 2
        assert shown.plot() is not None


def test_frame_of_views_takes_arrays():
    body, poses = motion()
    front, side = views()[0]
    frame = regkit.frame_of_views(
        {"front": front.data.depth, "side": side.data.points},
        {"front": np.eye(4), "side": side.T_world_camera},
        {"front": CAMERA, "side": CAMERA},
    )
    np.testing.assert_allclose(
        frame.points[-len(side.data.points) :],
        transformed(side.T_world_camera, side.data.points),
        atol=1e-12,
    )
    found = regkit.register(frame, TEMPLATE, start=poses[0], **SETTINGS)
    assert found.verdict == "found"
    assert np.linalg.norm(found.pose.root[:3, 3] - poses[0].root[:3, 3]) < 0.1
    assert body.size == found.size


@pytest.mark.parametrize(
    ("poses", "words"),
    [
        ({"fornt": np.eye(4)}, "did you mean 'fornt'"),
        ({"front": np.diag([1.0, 1.0, -1.0, 1.0])}, "reflects"),
    ],
)
def test_frame_of_views_names_what_is_wrong(poses, words):
    with pytest.raises(RegkitError, match=words):
        regkit.frame_of_views({"front": np.zeros((5, 3)) + 1.0}, poses)


def test_several_bodies_are_told_apart_in_one_camera_only():
    with pytest.raises(RegkitError, match="one camera"):
        regkit.track_each([Frame.of_views(one) for one in views()[:2]], TEMPLATE)


@pytest.mark.parametrize("method", ["best", "spheres", "icp", "paper"])
def test_scan_of_all_sides_without_a_camera_is_registered(method):
    body, poses = motion()
    truth = poses[0]
    places = body.surface.place(body.place(truth).transforms)
    step = 0.08 * np.random.default_rng(3).normal(size=body.skeleton.dofs)
    near = body.skeleton.limits.projected(body.skeleton.retract(truth, step))
    found = regkit.register(places, TEMPLATE, method, start=near, **SETTINGS)
    true = body.markers.place(body.place(truth).transforms)
    before = body.markers.place(body.place(near).transforms)
    off = np.linalg.norm(found.markers - true, axis=1).mean()
    assert off < 0.5 * np.linalg.norm(before - true, axis=1).mean()
    assert found.verdict == "found"
