"""A hand is kept with its forearm, also where this hangs on a person."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from lamp import CAMERA, seen
from scenes import Frames, frame_of

from regkit.geometry.rigid import rigid
from regkit.interfaces import Expected
from regkit.observation import Frame
from regkit.skeleton import Pose
from regkit_plugins.segmenters.gate import Gate
from regkit_plugins.segmenters.pieces import Pieces
from regkit_plugins.templates.hand import Hand

HAND, LONG = (Hand(length=0.19, forearm=part).body(0.19) for part in (False, True))


def posed(body, aside: float = 0.0) -> Pose:
    """The hand upright before the camera, the palm towards it."""
    rest = body.skeleton.rest()
    root = rigid(np.diag([1.0, -1.0, -1.0]), np.array([aside, 0.0, 0.6]))
    return Pose(root, rest.balls, rest.hinges)


def depth_of(body, aside: float = 0.0) -> np.ndarray:
    return np.nan_to_num(seen(body, posed(body, aside), image=True).depth)


def ball(place: list[float], radius: float) -> np.ndarray:
    """Returns the depth image of a ball."""
    rays = CAMERA.rays()
    square, along = (rays**2).sum(axis=2), rays @ np.array(place)
    inner = along**2 - square * (np.dot(place, place) - radius**2)
    return np.where(inner > 0.0, (along - np.sqrt(np.maximum(inner, 0.0))) / square, 0.0)


def nearest(*depths: np.ndarray) -> np.ndarray:
    found = np.min([np.where(one > 0.0, one, np.inf) for one in depths], axis=0)
    return np.where(np.isfinite(found), found, 0.0)


def of(*depths: np.ndarray, fps: float = 30.0) -> tuple[Frames, Frame]:
    """Returns a recording of the nearest surfaces, and its frame."""
    frame = frame_of(nearest(*depths), CAMERA)
    return Frames("frames", fps, 1, given=(frame,)), frame


def kept(recording: Frames, frame: Frame, expected: Expected | None = None) -> np.ndarray:
    left = Pieces().bind(recording, Hand(length=0.19)).segmented(frame, expected)
    return np.nan_to_num(left.depth) > 0.0


def same(found: np.ndarray, depth: np.ndarray) -> bool:
    """Returns whether nothing but a depth image is found, and but for a few pixels all of it."""
    return found[depth > 0.0].mean() > 0.98 and not found[depth == 0.0].any()


@pytest.mark.parametrize("body", [HAND, LONG], ids=["hand", "with forearm"])
def test_hand_is_kept_and_not_the_face_behind_it(body):
    hand = depth_of(body)
    found = kept(*of(hand, ball([0.2, -0.05, 0.85], 0.09)))
    assert same(found, hand)


def test_hand_that_hangs_on_a_person_is_kept_with_what_is_beside_it():
    """The forearm ends in a trunk, with which it is one piece."""
    hand, trunk = depth_of(LONG, -0.12), ball([-0.05, 0.35, 0.75], 0.25)
    recording, frame = of(hand, trunk)
    found = kept(recording, frame)
    alone = depth_of(HAND, -0.12) > 0.0
    assert found[alone].mean() > 0.9
    assert found.sum() < 1.5 * (hand > 0.0).sum() < (nearest(hand, trunk) > 0.0).sum()


def test_hand_that_moved_between_rare_frames_is_found_again():
    """At the usual rate, the forearm that stays where it was is the body, however unlike one."""
    last = Expected(LONG, posed(LONG, -0.2), posed(LONG, -0.2))
    hand, left = depth_of(LONG, 0.1), depth_of(LONG, -0.2)
    left[: len(left) // 2 + 10] = 0.0
    often, rare = (kept(*of(hand, left, fps=fps), last) for fps in (30.0, 2.0))
    assert same(often, left)
    assert same(rare, hand)


def test_gate_is_wider_between_rare_frames():
    recording, frame = of(depth_of(LONG))
    moved = Expected(LONG, posed(LONG, 0.1), posed(LONG, 0.1))
    slow = replace(recording, fps=5.0)
    left = [Gate().bind(one, Hand()).segmented(frame, moved) for one in (recording, slow)]
    assert len(left[0].points) < len(left[1].points) == len(frame.points)
