"""Rooms hide a body and change nothing else of it; their parts stand where they are said to."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from regkit.geometry.camera import Camera
from regkit.geometry.rotation import vector_to_matrix
from regkit.sensors import Sensor
from regkit_synthesis.recordings.digest import digest
from regkit_synthesis.recordings.scene import BODY
from regkit_synthesis.recordings.take import Take
from regkit_synthesis.rooms import ROOMS, Box, Chair, Person, Region, Table

SENSOR = Sensor(Camera(width=88, height=72, fx=115.0, fy=115.0, cx=43.5, cy=35.5), 0.0, 1000.0)
HOVERING = {"kind": "clip", "name": "walk", "grounded": False}
"""Off the ground, which spares the search for the soles over the whole motion."""
WALK = {"motion": HOVERING, "frames": 2, "view": {"elevation_deg": 15, "heading_deg": 20}}
REGION = Region(np.array([-0.4, -0.3, 0.1]), np.array([0.6, 0.5, 1.8]))
TIMES = np.array([0.0, 0.5])


@cache
def scene(room="none", frames=1, **fields):
    return Take.model_validate({**WALK, "room": room, **fields}).scene("walk", SENSOR, 2.0, frames)


def in_room(parts, **view):
    fields = {**WALK, "room": parts, "view": {**WALK["view"], **view}}
    return Take.model_validate(fields).scene("walk", SENSOR, 2.0, 1)


def seen(one):
    """The exact depth and the labels of a scene's first frame."""
    return next(one.views()).depth, next(one.labels())


@pytest.mark.parametrize("room", [name for name in ROOMS if name != "none"])
def test_room_hides_the_body_and_changes_nothing_else_of_it(room):
    alone, depth, labels = seen(scene())[0], *seen(scene(room))
    body = labels == BODY
    assert body.sum() > 0.3 * (alone > 0.0).sum()
    assert np.array_equal(depth[body], alone[body])
    hidden = (alone > 0.0) & ~body
    assert (depth[hidden] < alone[hidden]).all()
    assert set(np.unique(labels)) <= {0, *range(BODY, BODY + 1 + len(ROOMS[room]))}
    assert np.array_equal(scene(room).truth(), scene().truth())


def test_floor_hides_nothing_of_the_body():
    alone, labels = seen(scene())[0], seen(scene("floor"))[1]
    assert np.array_equal(labels == BODY, alone > 0.0)


def test_wall_in_front_hides_the_body():
    wall = {"wall": {"kind": "wall", "side": "front", "distance": 0.3}}
    assert (seen(in_room(wall))[1] == BODY).mean() == 0.0


def test_walls_face_the_camera_whatever_the_heading():
    for heading in (0.0, 130.0):
        one = in_room("wall_only", elevation_deg=0.0, heading_deg=heading)
        depth, labels = seen(one)
        farthest = max(one.mesh.posed(pose)[:, 2].max() for pose in scene_poses(one))
        assert np.allclose(depth[labels == 2], farthest + 0.5, atol=1e-5)


def scene_poses(one):
    """The bone poses of all frames of the take, beside which its room is placed."""
    return [one.bone_poses(frame / one.fps) for frame in range(WALK["frames"])]


def test_floor_is_under_the_lowest_sole_and_rolls_with_the_camera():
    one = in_room("floor", elevation_deg=35.0, roll_deg=50.0)
    depth, labels = seen(one)
    level = vector_to_matrix(np.radians([35.0, 0.0, 0.0])) @ [0.0, -1.0, 0.0]
    up = vector_to_matrix(np.radians([0.0, 0.0, -50.0])) @ level
    heights = SENSOR.camera.back_projected(np.where(labels == 2, depth, 0.0)) @ up
    lowest = min((one.mesh.posed(pose) @ up).min() for pose in scene_poses(one))
    assert len(heights) > 500
    assert np.allclose(heights, lowest, atol=1e-5)


def test_empty_room_is_what_is_behind_the_body():
    (depth, labels), (background, _) = seen(scene("walls")), seen(scene("walls", empty=True))
    body = labels == BODY
    assert np.array_equal(depth[~body], background[~body])
    assert (background[body] > depth[body]).all()
    assert scene("walls", empty=True).joints == ()
    assert scene("walls", empty=True).truth().shape == (1, 0, 3)


@pytest.mark.parametrize("heading", [0.0, 33.0, 90.0])
@pytest.mark.parametrize(
    "make", [Chair, Table, lambda **fields: Box(size=(0.4, 0.15, 0.25), **fields)]
)
def test_furniture_stands_on_the_ground_at_its_side(make, heading):
    for side, axis, ends in (
        ("back", 1, lambda own: own.lower[1] - REGION.upper[1]),
        ("front", 1, lambda own: REGION.lower[1] - own.upper[1]),
        ("left", 0, lambda own: REGION.lower[0] - own.upper[0]),
        ("right", 0, lambda own: own.lower[0] - REGION.upper[0]),
    ):
        part = make(side=side, distance=0.2, shift=0.3, heading_deg=heading)
        own = Region.around([part.surface(REGION, TIMES).vertices(0.0)])
        assert ends(own) == pytest.approx(0.2)
        assert (own.middle - REGION.middle)[1 - axis] == pytest.approx(0.3)
        assert own.lower[2] == pytest.approx(0.1)


def test_box_has_its_size_floats_and_moves():
    box = Box(size=(0.5, 0.2, 0.3), above=0.7, velocity=(1.0, -2.0))
    surface = box.surface(REGION, TIMES)
    first, later = surface.vertices(0.0), surface.vertices(0.5)
    assert np.allclose(np.ptp(first, axis=0), [0.5, 0.2, 0.3])
    assert first[:, 2].min() == pytest.approx(0.8)
    assert np.allclose(later - first, [0.5, -1.0, 0.0])
    assert not surface.still
    assert Box(size=(0.5, 0.2, 0.3)).surface(REGION, TIMES).still


def test_box_is_closed_and_seen_from_outside():
    surface = Box(size=(1.0, 2.0, 3.0)).surface(REGION, TIMES)
    a, b, c = np.moveaxis(surface.vertices(0.0)[surface.faces], 1, 0)
    assert (np.cross(a, b) * c).sum() / 6.0 == pytest.approx(6.0)


def test_second_person_stays_beside_the_region_of_the_first():
    person = Person(motion=HOVERING, side="left", distance=0.1, heading_deg=90.0)
    surface = person.surface(REGION, TIMES)
    own = Region.around(surface.vertices(time) for time in TIMES)
    assert own.upper[0] == pytest.approx(REGION.lower[0] - 0.1)
    assert own.lower[2] == pytest.approx(REGION.lower[2])
    assert np.abs(surface.vertices(0.5) - surface.vertices(0.0)).max() > 0.1


def test_digest_changes_with_what_the_room_shows():
    box = {"kind": "box", "size": (0.5, 0.5, 0.5)}
    rooms = [{"box": box}, {"other": box}, {"box": {**box, "velocity": (0.1, 0.0)}}]
    scenes = [Take.model_validate({**WALK, "room": r}).scene("walk", SENSOR, 2.0, 2) for r in rooms]
    scenes += [scene(), scene("floor"), scene("walls", empty=True), scene("walls")]
    assert len({digest(one, 0) for one in scenes}) == len(scenes)
