"""Verdicts of starts, on a lamp."""

import numpy as np
import pytest
from lamp import LAMP, facing, seen

from regkit.body import BodyDescription
from regkit.body.verdict import Verdict
from regkit.config.document import Document
from regkit.geometry.rigid import rigid
from regkit.observation import Observation
from regkit.skeleton import Pose
from regkit.start import judged
from regkit_plugins.templates.human import Human


@pytest.fixture(scope="module")
def lamp(tmp_path_factory):
    path = tmp_path_factory.mktemp("lamp") / "lamp.yaml"
    path.write_text(LAMP)
    return Document.read(path).validated(BodyDescription).body("lamp", 1.0)


@pytest.fixture(scope="module")
def pose(lamp):
    return facing(lamp, 0.2, {"arm": 20.0, "head": -60.0})


@pytest.fixture(scope="module")
def observation(lamp, pose):
    return seen(lamp, pose, image=True)


def moved(pose: Pose, by: np.ndarray) -> Pose:
    return Pose(rigid(pose.root[:3, :3], pose.root[:3, 3] + by), pose.balls, pose.hinges)


def test_right_pose_is_found_without_a_reason(lamp, pose, observation):
    start = judged(lamp, pose, observation)
    assert (start.verdict, start.reason) == (Verdict.FOUND, "")


def test_pose_beside_the_data_is_lost(lamp, pose, observation):
    start = judged(lamp, moved(pose, np.array([0.5, 0.0, 0.0])), observation)
    assert start.verdict is Verdict.LOST
    assert "% of the points" in start.reason


@pytest.mark.parametrize(
    ("margin", "verdict"),
    [(0.02, Verdict.DOUBTFUL), (0.8, Verdict.FOUND), (np.nan, Verdict.FOUND)],
)
def test_close_rival_makes_a_start_doubtful(lamp, pose, observation, margin, verdict):
    start = judged(lamp, pose, observation, margin)
    assert start.verdict is verdict
    assert ("mirrored" in start.reason) == (verdict is Verdict.DOUBTFUL)


def test_doubts_of_the_search_are_told(lamp, pose, observation):
    start = judged(lamp, pose, observation, doubts=["too small"])
    assert (start.verdict, start.reason) == (Verdict.DOUBTFUL, "too small")


def test_cupboard_where_a_person_would_stand_is_furniture(random):
    person = Human(height=1.7).body(1.7)
    pose = person.skeleton.rest(rigid(np.diag([1.0, -1.0, -1.0]), np.array([0.0, 0.0, 3.0])))
    placed = person.capsules.place(person.place(pose).transforms).ends.reshape(-1, 3)
    low, high = np.percentile(placed, [10, 90], axis=0)
    across, along, deep = random.uniform(low, high, size=(600, 3)).T
    front = np.column_stack([across, along, np.full(600, low[2] - 0.1)])
    side = np.column_stack([np.full(600, high[0]), along, deep])
    points = np.concatenate([front, side])
    start = judged(person, pose, Observation(points, np.ones(1200), np.full(1200, 1e-4)))
    assert start.verdict is Verdict.LOST
    assert "two planes" in start.reason
