"""The presets ``people`` and ``hands``: bodies stay in the image, and move as bodies do."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from regkit.body import BodyDescription
from regkit.config.document import Document
from regkit_plugins.datasets.synthetic import Synthetic
from regkit_plugins.presets import HANDS, PEOPLE
from regkit_plugins.templates import FOLDER

PRESETS = {path.stem: Document.read(path).validated(Synthetic) for path in (PEOPLE, HANDS)}
PEOPLE_TAKES = [("people", name) for name in PRESETS["people"].takes]
HAND_TAKES = [("hands", name) for name in PRESETS["hands"].takes]
TAKES = PEOPLE_TAKES + HAND_TAKES

BONES = {
    "people": [
        ("left_shoulder", "left_elbow"),
        ("left_elbow", "left_wrist"),
        ("right_hip", "right_knee"),
        ("right_knee", "right_ankle"),
        ("right_ankle", "right_foot"),
        ("left_hip", "right_hip"),
    ],
    "hands": [
        ("wrist", "index_mcp"),
        ("index_mcp", "little_mcp"),
        ("thumb_cmc", "thumb_mcp"),
        ("thumb_ip", "thumb_tip"),
        ("middle_mcp", "middle_pip"),
        ("middle_pip", "middle_dip"),
        ("ring_dip", "ring_tip"),
    ],
}
"""Some rigid bones: pairs of joints whose distance never changes."""


@cache
def _scene(preset, name):
    dataset = PRESETS[preset]
    take = dataset.takes[name]
    return take.scene(name, dataset.sensor(), dataset.fps, take.frames)


@cache
def _joints(preset, name):
    """Where each joint is in every image (T, 3), by its name."""
    scene = _scene(preset, name)
    return dict(zip(scene.landmarks, np.moveaxis(scene.truth(), 1, 0), strict=True))


def test_presets_have_two_subjects_each_and_enough_recordings():
    for preset, subjects, count in (
        ("people", {"average", "small"}, 13),
        ("hands", {"average", "slim"}, 6),
    ):
        found = PRESETS[preset].chosen()
        assert {recording.subject for recording in found} == subjects
        assert len(found) == count
        assert all(60 <= recording.length <= 90 for recording in found)


@pytest.mark.parametrize(("preset", "name"), TAKES)
def test_whole_body_stays_in_the_image(preset, name):
    """Every vertex is seen from a camera that would be a pixel smaller on every side."""
    scene = _scene(preset, name)
    camera = scene.sensor.camera
    for pose in scene.poses()[::12]:
        pixels = camera.projected(scene.mesh.posed(pose))
        assert pixels.min() > 0.5
        assert (pixels.max(axis=0) < [camera.width - 1.5, camera.height - 1.5]).all()


@pytest.mark.parametrize(("preset", "name"), PEOPLE_TAKES)
def test_person_is_at_the_distance_and_shows_its_front(preset, name):
    joints = _joints(preset, name)
    assert 2.5 < joints["pelvis"][:, 2].mean() < 3.3
    across = joints["left_shoulder"] - joints["right_shoulder"]
    headings = np.degrees(np.arctan2(across[:, 2], across[:, 0]))
    assert np.abs(headings).max() < 95.0
    assert abs(headings[0]) < 65.0


@pytest.mark.parametrize(("preset", "name"), HAND_TAKES)
def test_hand_is_at_the_distance_and_begins_open(preset, name):
    joints = _joints(preset, name)
    assert np.abs(joints["middle_mcp"][:, 2] - 0.4).max() < 0.05
    reach = joints["middle_tip"] - joints["wrist"]
    assert reach[0] @ [0.0, -1.0, 0.0] > 0.13  # The fingers are stretched, and point up.
    across = joints["index_mcp"] - joints["little_mcp"]
    assert across[0, 0] > 0.9 * np.linalg.norm(across[0])  # The palm looks into the camera.


@pytest.mark.parametrize(("preset", "name"), TAKES)
def test_bones_keep_their_lengths(preset, name):
    joints = _joints(preset, name)
    for start, end in BONES[preset]:
        assert np.ptp(np.linalg.norm(joints[end] - joints[start], axis=1)) < 1e-6


@pytest.mark.parametrize(("preset", "name"), TAKES)
def test_motion_is_continuous(preset, name):
    truth = np.stack(list(_joints(preset, name).values()), axis=1)
    steps = np.diff(truth, axis=0)
    speed = 2.0 if name.endswith("_fast") else 1.0
    fastest, jerkiest = (0.25, 0.18) if preset == "people" else (0.035, 0.015)
    assert np.linalg.norm(steps, axis=-1).max() < speed * fastest
    assert np.linalg.norm(np.diff(steps, axis=0), axis=-1).max() < speed * jerkiest


def test_names_say_what_is_seen():
    takes = PRESETS["people"].takes
    for name, take in takes.items():
        assert take.noise == (0.02 if name.endswith("_noisy") else None)
        assert take.motion.speed == (
            2.0 if name.endswith("_fast") else pytest.approx(0.87, abs=0.14)
        )
        assert name.startswith(f"{take.body}_")
    assert takes["average_walk_oblique"].view.heading_deg == 60.0
    joints = _joints("people", "small_walk_above")
    assert (joints["head"][:, 2] < joints["pelvis"][:, 2] - 0.1).all()


def test_every_recording_has_noise_of_its_own():
    streams = [take.noise_stream for dataset in PRESETS.values() for take in dataset.takes.values()]
    assert len(set(streams)) == 19


@pytest.mark.parametrize(
    ("preset", "name", "file"),
    [
        ("people", "average_run", "human.yaml"),
        ("people", "small_jump", "human_small.yaml"),
        ("hands", "average_fists", "hand_right.yaml"),
    ],
)
def test_template_has_the_bones_of_the_body(preset, name, file):
    description = Document.read(FOLDER / file).validated(BodyDescription)
    body = description.body(file, description.size.value)
    places = body.markers.place(body.place(body.skeleton.rest()).transforms)
    rest = dict(zip(body.markers.names, places, strict=True))
    joints = _joints(preset, name)
    for start, end in BONES[preset]:
        true = np.linalg.norm(joints[end] - joints[start], axis=1)
        assert np.linalg.norm(rest[end] - rest[start]) == pytest.approx(true, abs=0.002)
