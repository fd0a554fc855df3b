"""The background is what is static, not who stands still."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import frame_of, recording, write_recording

from regkit.observation import Frame
from regkit.system.errors import DataError
from regkit.testing.samples import CAMERA
from regkit.testing.scenes import SceneTemplate
from regkit_plugins.segmenters.background import Background

TEMPLATE = SceneTemplate()
PERSON = slice(40, 100), slice(60, 90)
CHAIR = slice(80, 110), slice(120, 150)
WINDOW = slice(0, 30), slice(0, 30)


def room(*, person: bool, noise: float = 0.0, seed: int = 0) -> np.ndarray:
    """Returns an image of a wall with a chair and a window, out of range, and perhaps a person."""
    depth = np.full((CAMERA.height, CAMERA.width), 3.0)
    depth[CHAIR] = 2.2
    if person:
        depth[PERSON] = 2.0
    depth += noise * np.random.default_rng(seed).normal(size=depth.shape)
    depth[WINDOW] = 0.0
    return depth


def test_person_who_stands_still_in_most_frames_is_no_background():
    depths = [room(person=index >= 4, noise=0.004, seed=index) for index in range(20)]
    scene = recording(*depths)
    frame = list(scene.frames())[-1]
    left = Background().bind(scene, TEMPLATE).segmented(frame, None)
    seen = left.depth > 0.0
    assert seen[PERSON].mean() > 0.9
    outside = np.ones_like(seen)
    outside[PERSON] = False
    assert seen[outside].mean() < 0.005


def test_what_stands_before_the_body_is_unknown_and_the_wall_is_free():
    near = room(person=False)
    near[CHAIR] = 1.5
    depths = [near] * 5 + [np.where(room(person=True) == 2.0, 2.0, near)] * 3
    scene = recording(*depths)
    left = Background().bind(scene, TEMPLATE).segmented(list(scene.frames())[-1], None)
    assert np.isnan(left.depth[CHAIR]).all()
    assert left.depth[120, 20] == 0.0


def test_pixel_without_a_measurement_is_unknown_where_there_is_a_background():
    depths = [room(person=False)] * 6
    shadowed = room(person=True)
    shadowed[40:100, 90:96] = 0.0
    left = Background().bind(recording(*depths), TEMPLATE).segmented(frame_of(shadowed), None)
    assert np.isnan(left.depth[40:100, 90:96]).all()
    assert (left.depth[WINDOW] == 0.0).all()


def test_pixel_out_of_range_has_no_background_unless_it_is_a_dropout():
    random = np.random.default_rng(1)
    depths = []
    for _ in range(20):
        depth = room(person=False)
        depth[random.random(depth.shape) < 0.2] = 0.0
        depths.append(depth)
    visitor = room(person=False)
    visitor[WINDOW] = 1.0
    scene = recording(*depths)
    bound = Background().bind(scene, TEMPLATE)
    (frame,) = recording(visitor).frames()
    seen = bound.segmented(frame, None).depth > 0.0
    assert seen[2:28, 2:28].all()
    seen[WINDOW] = False
    assert not seen.any()


def test_empty_recording_shows_what_a_body_hides_all_the_time(tmp_path):
    folder = write_recording(tmp_path / "empty", [room(person=False)])
    scene = recording(room(person=True))
    (frame,) = scene.frames()
    left = Background(empty=folder).bind(scene, TEMPLATE).segmented(frame, None)
    assert (left.depth > 0.0)[PERSON].mean() > 0.9
    assert (left.depth > 0.0).sum() <= left.depth[PERSON].size


def test_background_refuses_few_frames_clouds_and_other_recording():
    with pytest.raises(DataError, match=r"1 frames do not show what is static"):
        Background().bind(recording(room(person=True)), TEMPLATE)
    scene = recording(*[room(person=False)] * 5)
    bound = Background().bind(scene, TEMPLATE)
    frame = next(scene.frames())
    with pytest.raises(DataError, match=r"learned from depth images"):
        bound.segmented(replace(frame, depth=None), None)
    small = np.ones((CAMERA.height // 2, CAMERA.width // 2))
    with pytest.raises(DataError, match=r"the image is 88x72, the background 176x144"):
        bound.segmented(Frame(np.ones((small.size, 3)), None, small), None)
