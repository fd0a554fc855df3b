"""Lost bodies: when they are sought anew, that they are found, and that ties change nothing."""

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
import pytest
from lamp import LAMP, facing, seen

from regkit.body import Body
from regkit.interfaces import Evaluation, Method, Past, Registrar, RegistrationResult, Tracker
from regkit.interfaces.tracker import SEARCHES
from regkit.observation import Observation
from regkit.search.limb_recovery import LimbRecovery
from regkit.skeleton import Pose
from regkit.system.optional import one_blas_thread
from regkit_plugins.templates.file import FileTemplate
from regkit_plugins.trackers.constant_velocity import ConstantVelocity, reinitialization
from regkit_plugins.trackers.constant_velocity.recovery import Recovery
from regkit_plugins.trackers.constant_velocity.reinitialization import Reinitialization

SMALL = Reinitialization(exemplars=1000, looked_up=150, refined=10, finalists=3)
JOINTS = {"arm": 20.0, "head": -75.0}


@pytest.fixture(scope="module")
def lamp(tmp_path_factory) -> Body:
    path = tmp_path_factory.mktemp("lamp") / "lamp.yaml"
    path.write_text(LAMP)
    return FileTemplate(path=path, size=1.0).body(1.0)


@pytest.fixture(scope="module")
def registrar(lamp) -> Registrar:
    return Method.parse({"preset": "best"}, place="test", field="method").bind(lamp)


@dataclass
class Scripted(Registrar):
    """Leaves every pose as it is, and calls it as good as it was told."""

    body: Body
    share: float = 0.5

    def register(self, observation, candidates, *, prior=None, warm_start=None):
        return RegistrationResult(candidates[0], 0.0, self.share, True, 1, 1, "")

    def evaluate(self, observation, pose) -> Evaluation:
        return Evaluation(0.0, np.full(len(observation.points), self.share))


def result(pose: Pose, share: float = 0.95) -> RegistrationResult:
    return RegistrationResult(pose, 0.0, share, True, 1, 1, "")


def healthy(pose: Pose, frames: int = 5) -> Past:
    past = Past.start(pose)
    for _ in range(frames):
        past = past.followed_by(result(pose))
    return past


def far(body: Body, found: Pose, truth: Pose) -> float:
    """The mean distance of the markers [m]."""
    places = [body.markers.place(body.place(pose).transforms) for pose in (found, truth)]
    return float(np.linalg.norm(places[0] - places[1], axis=1).mean())


@pytest.mark.parametrize("gap", [0, 5])
@pytest.mark.parametrize("turn", [1.6, 3.1])
def test_body_that_comes_back_turned_is_found_in_the_first_frame(lamp, registrar, turn, gap):
    before, truth = facing(lamp, 0.0, JOINTS), facing(lamp, turn, {"arm": 5.0, "head": -60.0})
    past = healthy(before)
    for _ in range(gap):
        past = past.interrupted()
    errors = {}
    for name, body in (("sought", SMALL), ("not sought", None)):
        tracker = ConstantVelocity(recovery=Recovery(reinitialization=body)).bind(registrar)
        with one_blas_thread():
            found = tracker.step(seen(lamp, truth), past)
        errors[name] = far(lamp, found.pose, truth)
        assert bool(found.searched) == (body is not None)
    assert errors["sought"] < 0.03
    assert errors["not sought"] > 0.1


def test_pose_that_is_right_stays_after_a_gap(lamp, registrar):
    truth = facing(lamp, 0.3, JOINTS)
    past, data = healthy(truth).interrupted(), seen(lamp, truth)
    poses = []
    for body in (SMALL, None):
        tracker = ConstantVelocity(recovery=Recovery(reinitialization=body)).bind(registrar)
        with one_blas_thread():
            poses.append(tracker.step(data, past).pose)
    np.testing.assert_array_equal(poses[0].root, poses[1].root)
    np.testing.assert_array_equal(poses[0].hinges, poses[1].hinges)


@cache
def some_points(count: int) -> Observation:
    points = np.random.default_rng(0).normal(size=(count, 3))
    return Observation(points, np.ones(count), np.full(count, 1e-4))


@pytest.fixture
def sought(monkeypatch) -> list[int]:
    """The searches for the body, which find nothing."""
    calls = []

    def none(self, observation, last):
        calls.append(len(observation.points))
        return []

    monkeypatch.setattr(reinitialization.BoundReinitialization, "_finalists", none)
    return calls


def stepped(tracker, past: Past, data: Observation | None) -> Past:
    return past.interrupted() if data is None else past.followed_by(tracker.step(data, past))


def bound(body: Body, share: float) -> Tracker:
    recovery = Recovery(samples=10, reinitialization=SMALL)
    return ConstantVelocity(recovery=recovery).bind(Scripted(body, share))


def test_nothing_is_sought_while_nothing_is_wrong(lamp, sought):
    past, tracker = healthy(lamp.skeleton.rest()), bound(lamp, 0.93)
    for _ in range(50):
        past = stepped(tracker, past, some_points(100))
    assert sought == []
    assert past.searches == ()


def test_the_start_is_not_sought_again(lamp, sought):
    stepped(bound(lamp, 0.5), Past.start(lamp.skeleton.rest()), some_points(100))
    assert sought == []


def test_search_that_fails_becomes_rare(lamp, sought):
    # The usual share is that of the best quarter of all frames, so the alarm never ends.
    past, tracker, when = healthy(lamp.skeleton.rest(), 100), bound(lamp, 0.5), []
    for frame in range(260):
        count = len(sought)
        past = stepped(tracker, past, some_points(100))
        if len(sought) > count:
            when.append(frame)
    assert when[0] == 0
    gaps = np.diff(when)
    assert gaps[0] >= 4
    assert (gaps[1:] >= 1.5 * gaps[:-1]).all()
    assert len(when) <= 7


def test_first_frame_after_a_gap_is_searched_but_not_without_end(lamp, sought):
    past, tracker, when = healthy(lamp.skeleton.rest()), bound(lamp, 0.95), []
    for frame in range(300):
        count = len(sought)
        past = stepped(tracker, past, some_points(100) if frame % 2 else None)
        if len(sought) > count:
            when.append(frame)
    assert when[:3] == [1, 3, 5]
    assert all(later - first >= 100 for first, later in zip(when, when[SEARCHES:], strict=False))
    assert len(past.searches) <= SEARCHES


@pytest.mark.parametrize(("share", "found"), [(0.9, 0), (0.75, 1)])
def test_points_that_jump_start_a_search_even_if_limbs_explain_them(lamp, sought, share, found):
    tracker, past = bound(lamp, share), healthy(lamp.skeleton.rest())

    class Explained(LimbRecovery):
        def recovered(self, observation, found):
            return replace(found, inlier_share=0.95)

    limbs = Explained(tracker.registrar, (), 1, 0.01)
    tracker = replace(tracker, recovery=replace(tracker.recovery, limbs=limbs))
    for _ in range(2):
        past = stepped(tracker, past, some_points(100))
    # The second jump follows a frame in which the body was right again: it is another one.
    assert len(sought) == 2 * found


def test_body_that_enters_the_picture_is_sought_as_more_of_it_is_seen(lamp, sought):
    past, tracker = healthy(lamp.skeleton.rest(), 100), bound(lamp, 0.5)
    for count in (100, 140, 200, 290, 310):
        past = stepped(tracker, past, some_points(count))
    assert sought == [100, 200, 310]


@pytest.mark.parametrize(
    ("energy", "misfit", "share", "wins"),
    [
        (-1.0, -0.2, 0.2, True),
        (0.0, -0.2, 0.2, False),
        (-1.0, -0.01, 0.2, False),
        (-1.0, -0.2, 0.0, False),
    ],
    ids=["better by all measures", "not in energy", "not in misfit", "not in inliers"],
)
def test_tracked_pose_wins_ties(lamp, monkeypatch, energy, misfit, share, wins):
    past, tracker = healthy(lamp.skeleton.rest()), bound(lamp, 0.5)
    other = lamp.skeleton.rest(np.diag([1.0, -1.0, -1.0, 1.0]))

    def rivals(self, observation, last):
        found = tracker.registrar.register(observation, [last])
        tracked = reinitialization.Finalist.registered(self.limbs, found, observation, 1.0)
        rival = replace(tracked.result, pose=other, inlier_share=0.5 + share)
        return [replace(tracked, result=rival, energy=energy, misfit=tracked.misfit + misfit)]

    monkeypatch.setattr(reinitialization.BoundReinitialization, "_finalists", rivals)
    found = tracker.step(some_points(100), past)
    assert (found.pose is other) == wins
    assert found.searched == 100


def test_body_without_exemplars_is_tracked_without_them(lamp):
    fixed = replace(lamp, capsules=lamp.capsules.selected(np.zeros(len(lamp.capsules), dtype=bool)))
    past = healthy(lamp.skeleton.rest()).interrupted()
    assert bound(fixed, 0.5).step(some_points(100), past).searched == 0
