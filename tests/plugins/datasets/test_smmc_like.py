"""The 28 recordings of the preset smmc_like: whole bodies that move as bodies do."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from pydantic import TypeAdapter

from regkit.interfaces import Dataset

PRESET = TypeAdapter(Dataset).validate_python({"preset": "smmc_like"})


@cache
def scene_of(name):
    """Two seconds of a recording, which several tests look at."""
    return PRESET.takes[name].scene(name, PRESET.sensor(), PRESET.fps, 60)


@pytest.mark.parametrize("name", PRESET.takes)
def test_recording_shows_a_whole_body_that_moves_without_jumps(name):
    scene = scene_of(name)
    camera = scene.sensor.camera
    for pose in scene.poses()[::12]:
        pixels = camera.projected(scene.mesh.posed(pose))
        assert pixels.min() > 0.5
        assert (pixels.max(axis=0) < [camera.width - 1.5, camera.height - 1.5]).all()
    truth = scene.truth()
    steps = np.diff(truth, axis=0)
    fastest = np.linalg.norm(steps, axis=-1).max()
    assert 0.02 < fastest < 0.5  # Of 1/30 s.
    assert np.linalg.norm(np.diff(steps, axis=0), axis=-1).max() < 0.3


@pytest.mark.parametrize("name", PRESET.takes)
def test_recording_begins_facing_the_camera(name):
    scene = scene_of(name)
    truth = dict(zip(scene.joints, scene.truth()[0], strict=True))
    left = truth["left_hip"] - truth["right_hip"]
    assert abs(np.degrees(np.arctan2(left[2], left[0]))) < 75.0


def test_there_are_28_recordings_of_three_subjects():
    recordings = PRESET.model_copy(update={"frames": 20}).chosen()
    assert [s.name[:3] for s in recordings] == [f"{number:02d}_" for number in range(1, 29)]
    assert {s.subject for s in recordings} == {"average", "small", "tall"}
    assert {s.length for s in recordings} == {20}
    assert all(take.difficulty and take.view.distance is None for take in PRESET.takes.values())
