"""Planes that bound the scene are removed, from any side, and nothing else."""

import numpy as np
import pytest
from scenes import of_planes, recording

from regkit.testing.scenes import SceneTemplate
from regkit_plugins.segmenters.planes import Planes

TEMPLATE = SceneTemplate()
FLOOR, WALL = ((0.0, -1.0, -0.3), 1.2), ((0.3, 0.0, -1.0), 3.0)
BODY = slice(50, 90), slice(70, 100)


def scene(roll: float = 0.0) -> np.ndarray:
    """Returns a floor, a wall, and a thick body before them, with noise."""
    depth = of_planes([FLOOR, WALL], roll)
    rows, columns = np.mgrid[BODY]
    depth[BODY] = 1.6 - 0.1 * np.sin(np.pi * (columns - 70) / 30.0) + 0.0005 * rows
    noise = np.random.default_rng(2).normal(scale=0.004, size=depth.shape)
    return np.where(depth > 0.0, depth + noise, 0.0)


@pytest.mark.parametrize("roll_deg", [0, 70, 180])
def test_planes_are_found_in_any_roll_of_the_camera(roll_deg):
    frames = recording(scene(np.radians(roll_deg)))
    bound = Planes().bind(frames, TEMPLATE)
    assert len(bound.planes) == 2
    (frame,) = frames.frames()
    seen = bound.segmented(frame, None).depth > 0.0
    assert seen[BODY].mean() > 0.95
    seen[BODY] = False
    assert seen.mean() < 0.02


def test_removed_planes_are_free_space_and_tell_where_up_is():
    frames = recording(scene())
    bound = Planes().bind(frames, TEMPLATE)
    (frame,) = frames.frames()
    assert not np.isnan(bound.segmented(frame, None).depth).any()
    up = np.array(FLOOR[0]) / np.linalg.norm(FLOOR[0])
    assert bound.floor.normal @ up > 0.999
    for one in bound.planes:
        assert np.linalg.norm(one.normal) == pytest.approx(1.0)
        assert one.heights(np.zeros((1, 3)))[0] > 0.0
    rolled = Planes().bind(recording(scene(np.radians(70))), TEMPLATE)
    assert rolled.floor is None or abs(rolled.floor.normal[1]) > 0.7


def test_what_has_something_behind_it_is_no_plane_of_the_room():
    """Such as a table, a flat trunk before a room, or a box."""
    depth = of_planes([((0.0, 0.0, -1.0), 4.0)])
    depth[40:, 20:150] = 1.5
    frames = recording(depth)
    bound = Planes().bind(frames, TEMPLATE)
    (frame,) = frames.frames()
    seen = bound.segmented(frame, None).depth > 0.0
    assert seen[40:, 20:150].all()
    assert not seen[:40].any()


def test_body_alone_keeps_its_flat_sides():
    depth = np.zeros((144, 176))
    depth[20:120, 70:110] = 2.0
    frames = recording(depth)
    (frame,) = frames.frames()
    assert Planes().bind(frames, TEMPLATE).segmented(frame, None) is frame


def test_planes_of_a_moving_camera_are_sought_in_every_frame():
    first, second = scene(), scene(np.radians(90))
    frames = recording(first, second)
    bound = Planes(moving_camera=True).bind(frames, TEMPLATE)
    for frame in frames.frames():
        seen = bound.segmented(frame, None).depth > 0.0
        assert seen[BODY].mean() > 0.95
        seen[BODY] = False
        assert seen.mean() < 0.02
