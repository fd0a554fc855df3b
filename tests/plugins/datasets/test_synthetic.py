"""The dataset of rendered bodies: what its takes say, what is seen, and what mistakes are told."""

from __future__ import annotations

import numpy as np
import pytest

from regkit.config.document import Document
from regkit.geometry.camera import Camera
from regkit.sensors.cameras import CAMERAS
from regkit.system.errors import ConfigError, RegkitError
from regkit.system.files import write_text
from regkit_plugins.datasets.synthetic import Synthetic

TAKES = """\
kind: synthetic
defaults:
  frames: 3
  motion: {kind: clip, name: walk, way: 0.2}
  view: {distance: 3.0}
takes:
  walk: {}
  kick: {body: tall, motion: kick, frames: 2, view: {heading_deg: -40}}
"""


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    folder = tmp_path / "cache"
    monkeypatch.setenv("REGKIT_CACHE", str(folder))
    return folder


def dataset(tmp_path, text=TAKES, *settings):
    write_text(tmp_path / "dataset.yaml", text)
    return Document.read(tmp_path / "dataset.yaml").overridden(settings).validated(Synthetic)


def images(recording):
    return np.array([frame.depth for frame in recording.frames()])


def test_takes_have_what_the_defaults_say_and_what_they_say_themselves(tmp_path):
    walk, kick = dataset(tmp_path).takes.values()
    assert (walk.body, walk.frames, walk.motion.name, walk.motion.way) == (
        "average", 3, "walk", 0.2,
    )  # fmt: skip
    assert (kick.body, kick.frames, kick.motion.name, kick.motion.way) == ("tall", 2, "kick", 0.2)
    assert (kick.view.distance, kick.view.heading_deg) == (3.0, -40.0)


def test_recordings_are_named_and_have_the_subjects_of_their_bodies(tmp_path):
    found = dataset(tmp_path).chosen()
    assert [(s.name, s.subject, s.length, s.fps) for s in found] == [
        ("walk", "average", 3, 30.0),
        ("kick", "tall", 2, 30.0),
    ]
    assert [s.length for s in dataset(tmp_path, TAKES, "frames=2").chosen()] == [2, 2]
    own = dataset(tmp_path, TAKES, "takes.walk.subject=anna").chosen()
    assert own[0].subject == "anna"


def test_config_that_is_written_out_reads_the_same(tmp_path):
    first = dataset(tmp_path)
    again = Synthetic.model_validate(first.model_dump(mode="json"))
    assert again == first


def test_joints_lie_in_the_body_that_is_seen(tmp_path):
    (walk,) = dataset(tmp_path, TAKES, "recordings=[walk]", "noise=none").chosen()
    camera = CAMERAS["sr4000"].camera()
    truth = walk.truth()
    for depth, joints in zip(images(walk), truth.positions, strict=True):
        columns, rows = np.rint(camera.projected(joints)).astype(int).T
        seen = depth[rows, columns]
        assert (seen > 0.0).mean() > 0.9
        # A foot may miss the outline by a pixel, which shows what is behind it.
        assert (joints[:, 2] > seen - 0.001)[seen > 0.0].mean() > 0.9
    assert truth.positions[:, :, 2].mean() == pytest.approx(3.0, abs=0.1)


def test_truth_is_exact_and_needs_no_image(tmp_path, cache):
    (walk,) = dataset(tmp_path, TAKES, "recordings=[walk]").chosen()
    truth = dict(zip(walk.truth().joints, np.moveaxis(walk.truth().positions, 1, 0), strict=True))
    forearm = np.linalg.norm(truth["left_elbow"] - truth["left_wrist"], axis=1)
    assert np.ptp(forearm) < 1e-9
    assert not cache.exists()


def test_markers_are_points_of_the_skin(tmp_path):
    settings = ("recordings=[walk]", "noise=none", "takes.walk.markers={nose: 0, other: 5000}")
    (walk,) = dataset(tmp_path, TAKES, *settings).chosen()
    scene = walk.take.scene("walk", walk.dataset.sensor(), 30.0, 3)
    truth = walk.truth()
    assert truth.joints[-2:] == ("nose", "other")
    for index, pose in enumerate(scene.poses()):
        vertices = scene.mesh.posed(pose)[[0, 5000]]
        assert np.allclose(truth.positions[index, -2:], vertices, atol=1e-12)


def test_whole_body_is_in_the_image_if_the_distance_is_left_open(tmp_path):
    text = TAKES.replace("distance: 3.0", "elevation_deg: 20")
    for recording in dataset(tmp_path, text, "noise=none").chosen():
        for depth in images(recording):
            seen = depth > 0.0
            assert seen.any()
            assert not seen[[0, -1]].any()
            assert not seen[:, [0, -1]].any()


def test_heading_turns_the_body_to_the_right_of_the_image(tmp_path):
    for heading in (0.0, 50.0):
        setting = f"takes.walk.view.heading_deg={heading}"
        (walk,) = dataset(tmp_path, TAKES, "recordings=[walk]", setting).chosen()
        truth = dict(zip(walk.truth().joints, walk.truth().positions[0], strict=True))
        left = truth["left_hip"] - truth["right_hip"]
        assert np.degrees(np.arctan2(left[2], left[0])) == pytest.approx(heading, abs=8.0)


def test_camera_from_above_sees_the_head_nearer(tmp_path):
    (walk,) = dataset(
        tmp_path, TAKES, "recordings=[walk]", "takes.walk.view.elevation_deg=30"
    ).chosen()
    truth = dict(zip(walk.truth().joints, walk.truth().positions[0], strict=True))
    assert truth["head"][2] < truth["pelvis"][2] - 0.2


def test_without_noise_the_depth_is_exact_to_half_a_unit(tmp_path):
    (walk,) = dataset(tmp_path, TAKES, "recordings=[walk]", "noise=none").chosen()
    scene = walk.take.scene("walk", walk.dataset.sensor(), 30.0, 3)
    for depth, view in zip(images(walk), scene.views(), strict=True):
        assert np.abs(depth - view.depth).max() <= 0.0005 + 1e-9


def test_another_seed_changes_the_noise_alone(tmp_path):
    noise = "noise=0.01"
    first, other = (
        dataset(tmp_path, TAKES, "recordings=[walk]", noise, f"seed={seed}").chosen()[0]
        for seed in (0, 1)
    )
    assert np.array_equal(first.truth().positions, other.truth().positions)
    one, two = images(first), images(other)
    assert np.array_equal(one > 0.0, two > 0.0)
    assert (one - two)[one > 0.0].std() == pytest.approx(0.01 * np.sqrt(2.0), rel=0.05)


def test_noise_of_a_frame_does_not_depend_on_how_many_there_are(tmp_path):
    long, short = (
        dataset(tmp_path, TAKES, "recordings=[walk]", f"frames={frames}").chosen()[0]
        for frames in (3, 2)
    )
    assert np.array_equal(images(long)[:2], images(short))


def test_noise_differs_between_recordings_and_frames(tmp_path):
    text = """\
kind: synthetic
noise: 0.01
defaults:
  frames: 2
  view: {distance: 3}
  motion: {kind: keyframes, frames: [{time: 0}, {time: 1}]}
takes: {a: {}, b: {}}
"""
    (a, b) = (images(recording) for recording in dataset(tmp_path, text).chosen())
    assert not np.array_equal(a[0], a[1])
    assert not np.array_equal(a[0], b[0])
    assert np.array_equal(a[0] > 0.0, b[1] > 0.0)


def test_noise_of_one_stream_is_the_same_for_fewer_frames_and_another_name(tmp_path):
    stream = "takes={walk: {noise_stream: a}, again: {noise_stream: a}, other: {noise_stream: b}}"
    walk, again, other = dataset(tmp_path, TAKES, "noise=0.01", "takes={}", stream).chosen()
    assert np.array_equal(images(walk), images(again))
    assert not np.array_equal(images(walk), images(other))
    fewer = dataset(tmp_path, TAKES, "noise=0.01", "frames=2", "takes={}", stream).chosen()[0]
    assert np.array_equal(images(walk)[:2], images(fewer))


def test_take_may_have_noise_of_its_own(tmp_path):
    settings = ("noise=0.01", "takes.walk.noise=none", "recordings=[walk]")
    (walk,) = dataset(tmp_path, TAKES, *settings).chosen()
    scene = walk.take.scene("walk", walk.dataset.sensor(), 30.0, 3)
    for depth, view in zip(images(walk), scene.views(), strict=True):
        assert np.abs(depth - view.depth).max() <= 0.0005 + 1e-9


def test_camera_may_stand_at_a_given_place(tmp_path):
    text = """\
kind: synthetic
defaults: {frames: 1, motion: walk}
takes:
  level: {view: {place: [0.1, 0.8, 3]}}
  tilted: {view: {place: [0.1, 0.8, 3], elevation_deg: 20}}
"""
    level, tilted = (take.truth().positions[0] for take in dataset(tmp_path, text).chosen())
    middle = level.mean(axis=0)
    assert middle[[0, 2]] == pytest.approx([0.1, 3.0], abs=0.1)
    assert level[:, 1].max() == pytest.approx(0.75, abs=0.05)  # A foot's joint is above the sole.
    angle = np.radians(20.0)
    turn = [[1, 0, 0], [0, np.cos(angle), -np.sin(angle)], [0, np.sin(angle), np.cos(angle)]]
    assert np.allclose(tilted, level @ np.transpose(turn))


HAND = """\
kind: synthetic
camera: sr305
defaults: {frames: 2, view: {place: [0, 0, 0.4]}}
takes:
  fist: {body: {kind: hand, name: slim}, motion: {kind: gestures, name: fists}}
"""


def test_hand_makes_gestures_before_the_camera(tmp_path):
    (fist,) = dataset(tmp_path, HAND, "noise=none").chosen()
    truth = fist.truth()
    assert (fist.subject, len(truth.joints)) == ("slim", 21)
    assert truth.positions[..., 2].mean() == pytest.approx(0.4, abs=0.03)
    for depth in images(fist):
        assert (depth > 0.0).sum() > 1000


@pytest.mark.parametrize(
    ("text", "setting"),
    [(HAND, "takes.fist.motion={kind: clip, name: walk}"), (HAND, "takes.fist.body=small")],
)
def test_motion_of_another_kind_of_body_is_refused_at_its_place(tmp_path, text, setting):
    with pytest.raises(ConfigError, match=r"takes\.fist: .*hand"):
        dataset(tmp_path, text, setting)


def test_noise_is_that_of_the_camera_unless_another_is_asked_for(tmp_path):
    named = dataset(tmp_path, TAKES, "camera=kinect_v1")
    assert named.sensor().noise.inverse_depth_step is not None
    given = dataset(tmp_path, TAKES, "camera={width: 100, height: 80, fx: 90}")
    assert given.sensor().noise.model_dump(exclude_none=True) == {}
    assert given.sensor().camera == Camera(100, 80, 90.0, 90.0, 49.5, 39.5)


def test_camera_may_be_a_file_beside_the_yaml(tmp_path):
    write_text(tmp_path / "camera.json", Camera(64, 48, 60.0, 60.0, 31.5, 23.5).to_json())
    text = TAKES.replace("defaults:", "camera: {file: camera.json}\ndefaults:")
    (walk,) = dataset(tmp_path, text, "recordings=[walk]").chosen()
    assert images(walk).shape == (3, 48, 64)


@pytest.mark.parametrize(
    ("setting", "expected"),
    [
        ("camera=kinect", "camera: input should be 'sr4000', 'kinect_v1'"),
        ("camera={width: 10}", "camera.height: field required"),
        ("noise=-1", "noise: input should be greater than or equal to 0"),
        ("noise={axial: {constnt: 1}}", "noise.axial.constnt: no such field"),
        ("takes.walk.body=average_one", "takes.walk.body: input should be 'average', 'small'"),
        ("takes.walk.motion={kind: clip, name: wlk}", "takes.walk.motion: no clip called 'wlk'"),
        ("takes={}", "takes"),
        ("takes.walk.view={place: [0, 0, 3]}", "takes.walk.view: give a distance or a place"),
        ("takes={'a/b': {}}", "takes.a/b"),
        ("room=flor", "room: input should be 'none', 'floor', 'walls'"),
        ("takes.walk.room={cat: {kind: box}}", "takes.walk.room.cat.size: field required"),
        ("takes.walk.room={cat: {kind: cat}}", "takes.walk.room.cat"),
        ("takes.walk.room={friend: {kind: person, motion: wlk}}", "no clip called 'wlk'"),
        ("takes.walk.empty=true", "takes.walk: it is empty and has no room either"),
    ],
)
def test_mistake_is_told_at_its_place(tmp_path, setting, expected):
    with pytest.raises(ConfigError) as caught:
        dataset(tmp_path, TAKES, setting)
    assert expected in str(caught.value)


def test_clip_named_alone_is_checked_as_the_file_is_read(tmp_path):
    with pytest.raises(ConfigError, match=r"takes\.w\.motion: no clip called 'wlk' ships"):
        dataset(tmp_path, "kind: synthetic\ntakes: {w: {motion: wlk}}\n")


def test_camera_that_cannot_see_a_whole_body_is_told(tmp_path):
    camera = "camera: {width: 60, height: 50, fx: 20, cx: -5}"
    text = f"kind: synthetic\n{camera}\ntakes: {{w: {{motion: walk, frames: 1}}}}\n"
    (walk,) = dataset(tmp_path, text).chosen()
    with pytest.raises(ConfigError, match=r"principal point, \(-5, 24\.5\) px, is at the border"):
        walk.prepare()


ROOMS = """\
kind: synthetic
camera: {width: 44, height: 36, fx: 58}
room: floor
defaults:
  motion: {kind: clip, name: walk, grounded: false}
  frames: 1
  room: {cat: {kind: box, size: [0.5, 0.2, 0.3]}}
takes:
  plain: {room: none}
  named: {room: desk}
  added: {room: {wall: {kind: wall}, cat: {side: left}}}
  background: {room: furnished, empty: true}
"""


def test_room_is_that_of_the_take_over_that_of_the_defaults_over_that_of_the_dataset(tmp_path):
    names = {r.name: r.label_names()[2:] for r in dataset(tmp_path, ROOMS).chosen()}
    assert names["plain"] == ()
    assert names["named"] == ("floor", "back_wall", "desk")
    assert names["added"] == ("cat", "wall")
    parts = "takes.walk.room={wall: {kind: wall}}"
    named, _ = dataset(tmp_path, TAKES, "defaults.room=desk", parts).chosen()
    assert named.label_names()[2:] == ("wall",)
    walk, kick = dataset(tmp_path, TAKES, "room=floor", "takes.walk.room=none").chosen()
    assert walk.label_names() == ("nothing", "body")
    assert kick.label_names() == ("nothing", "body", "floor")


def test_empty_take_shows_its_room_without_joints(tmp_path):
    (empty,) = dataset(tmp_path, ROOMS, "recordings=[background]").chosen()
    assert empty.truth() is None
    assert (images(empty) > 0.0).mean() > 0.9
    (labels,) = empty.labels()
    assert {empty.label_names()[label] for label in np.unique(labels)} >= {"floor", "table"}
    assert 1 not in labels
    assert not (empty.folder() / "truth.csv").exists()


def test_labels_are_those_of_the_pixels_that_are_measured(tmp_path):
    (named,) = dataset(tmp_path, ROOMS, "recordings=[named]").chosen()
    for image, labels in zip(images(named), named.labels(), strict=True):
        assert np.array_equal(image > 0.0, labels > 0)
        nearest = [image[labels == label].min() for label in (1, 4)]
        assert nearest[1] < nearest[0]  # The desk is in front of the body.


def test_room_that_hides_the_body_is_told(tmp_path):
    below = "takes.named.view={elevation_deg: -60}"
    (named,) = dataset(tmp_path, ROOMS, "recordings=[named]", below).chosen()
    with pytest.raises(
        RegkitError, match=r"takes\.named: .*no frame shows the body: the room hides it"
    ):
        named.prepare()


def test_take_without_a_motion_is_refused(tmp_path):
    with pytest.raises(ConfigError, match=r"takes\.lazy: it has no motion"):
        dataset(tmp_path, "kind: synthetic\ntakes: {lazy: {body: small}}\n")


@pytest.mark.parametrize(
    ("setting", "expected"),
    [
        ("takes.walk.motion={kind: clip, path: nowhere.txt}", "nowhere.txt: there is no such file"),
        (
            "takes.walk={motion: {name: run, way: 1}, view: {heading_deg: 90, distance: 0.5}}",
            "the image of frame 0 does not show the body",
        ),
        ("takes.walk.markers={nose: 99999}", "marker 'nose' is vertex 99999"),
        ("takes.walk.markers={head: 1}", "a marker cannot be called 'head'"),
    ],
)
def test_take_that_cannot_be_rendered_is_named(tmp_path, setting, expected):
    (walk,) = dataset(tmp_path, TAKES, "recordings=[walk]", "fps=2", setting).chosen()
    with pytest.raises(RegkitError) as caught:
        walk.prepare()
    assert str(caught.value).startswith("dataset.takes.walk: this take cannot be rendered: ")
    assert expected in str(caught.value)
