"""Trackers: where they set out from, when they look for lost limbs, and that they find them."""

from dataclasses import dataclass, field

import numpy as np
import pytest

from regkit.body import Body
from regkit.experiment.experiment import Experiment
from regkit.geometry.rigid import rigid
from regkit.interfaces import Evaluation, Past, Registrar, RegistrationResult
from regkit.observation import Observation
from regkit.search.limb_search import LimbSearch
from regkit.search.limbs import limbs_of
from regkit.skeleton import Pose, PoseDescription
from regkit_plugins.templates.hand import Hand
from regkit_plugins.templates.human import Human
from regkit_plugins.trackers.constant_pose import ConstantPose
from regkit_plugins.trackers.constant_velocity.constant_velocity import ConstantVelocity
from regkit_plugins.trackers.constant_velocity.recovery import Recovery

NOTHING = Observation(np.zeros((1, 3)), np.ones(1), np.ones(1))


@dataclass
class Recorder(Registrar):
    """Finds whatever is expected, and notes from where it was to set out."""

    body: Body
    explained: float = 0.9
    calls: list[tuple[Pose, ...]] = field(default_factory=list)

    def register(self, observation, candidates, *, prior=None, warm_start=None):
        self.calls.append(tuple(candidates))
        return RegistrationResult(candidates[0], 0.0, self.explained, True, 1, 1, "")

    def evaluate(self, observation, pose) -> Evaluation:
        return Evaluation(0.0, np.full(len(observation.points), self.explained))


def seen(pose: Pose, explained: float = 0.9) -> RegistrationResult:
    return RegistrationResult(pose, 0.0, explained, True, 1, 1, "")


def test_constant_pose_sets_out_from_the_last_pose(linkage):
    recorder = Recorder(linkage)
    poses = [linkage.skeleton.rest(rigid(np.eye(3), np.array([x, 0, 2.0]))) for x in (0.0, 0.1)]
    found = (
        ConstantPose()
        .bind(recorder)
        .step(NOTHING, Past.start(poses[0]).followed_by(seen(poses[1])))
    )
    assert recorder.calls == [(poses[1],)]
    assert found.pose is poses[1]


def test_constant_velocity_offers_the_last_step_again_within_the_limits(linkage):
    bones = linkage.skeleton
    recorder = Recorder(linkage)
    step = np.zeros(bones.dofs)
    step[0] = 0.1
    step[bones.dofs_of("forearm")] = np.radians(80.0)  # Twice that is beyond 140 degrees.
    before, last = bones.rest(), bones.retract(bones.rest(), step)
    past = Past.start(before).followed_by(seen(before)).followed_by(seen(last))
    ConstantVelocity(recovery=None).bind(recorder).step(NOTHING, past)
    ((expected, predicted),) = recorder.calls
    assert expected is last
    np.testing.assert_allclose(predicted.root[:3, 3], [0.2, 0.0, 0.0])
    np.testing.assert_allclose(predicted.hinges.max(), np.radians(140.0))


@pytest.mark.parametrize("turn", [0.0, 1e-6, 0.3, 3.0])
def test_constant_velocity_repeats_the_difference_of_the_last_poses(raised, random, turn):
    body, before, _ = raised
    bones = body.skeleton
    step = random.normal(size=bones.dofs)
    # Each rotation of the step has the angle ``turn``.
    vectors = step[3 : bones.ball_dofs.stop].reshape(-1, 3)
    step[3 : bones.ball_dofs.stop] = (
        turn * vectors / np.linalg.norm(vectors, axis=1)[:, None]
    ).ravel()
    last = bones.retract(before, step)
    last = Pose(last.root, -last.balls, last.hinges)
    recorder = Recorder(body)
    past = Past.start(before).followed_by(seen(before)).followed_by(seen(last))
    ConstantVelocity(recovery=None).bind(recorder).step(NOTHING, past)
    ((_, predicted),) = recorder.calls
    expected = bones.limits.projected(bones.retract(last, bones.difference(before, last)))
    for name in ("root", "balls", "hinges"):
        np.testing.assert_allclose(
            getattr(predicted, name), getattr(expected, name), atol=1e-12, err_msg=name
        )


def test_repeated_motions_stay_rotations(raised, random):
    """However often, predictions that are taken as they are do not add up their rounding."""
    body, before, _ = raised
    bones = body.skeleton
    last = bones.retract(before, 0.01 * random.normal(size=bones.dofs))
    recorder = Recorder(body)
    bound = ConstantVelocity(recovery=None).bind(recorder)
    past = Past.start(before).followed_by(seen(before)).followed_by(seen(last))
    for _ in range(300):
        bound.step(NOTHING, past)
        past = past.followed_by(seen(recorder.calls[-1][1]))
    rotation = past.last.pose.root[:3, :3]
    np.testing.assert_allclose(rotation.T @ rotation, np.eye(3), atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(past.last.pose.balls, axis=1), 1.0, atol=1e-12)


def test_constant_velocity_has_no_step_to_repeat_at_first(linkage):
    recorder = Recorder(linkage)
    rest = linkage.skeleton.rest()
    ConstantVelocity(recovery=None).bind(recorder).step(NOTHING, Past.start(rest))
    assert recorder.calls == [(rest,)]


@pytest.mark.parametrize(
    ("explained", "frames", "looks"),
    [(0.94, 4, False), (0.90, 4, True), (0.94, 10, True)],
    ids=["as usual", "much less than usual", "as usual, but it is time"],
)
def test_recovery_looks_when_less_is_explained_than_usual(
    linkage, monkeypatch, explained, frames, looks
):
    looked = []

    def starts(self, points, pose, most, silhouette):
        looked.append(pose)
        return iter(())

    monkeypatch.setattr(LimbSearch, "starts", starts)
    recovery = Recovery(every=10, samples=10).bind(Recorder(linkage))
    rest = linkage.skeleton.rest()
    past = Past.start(rest)
    for _ in range(frames):
        past = past.followed_by(seen(rest, 0.95))
    found = seen(rest, explained)
    assert recovery.checked(NOTHING, found, past) is found
    assert bool(looked) == looks


def test_limbs_are_what_hangs_on_the_trunk():
    human = {limb.name for limb in limbs_of(Human().body(1.7))}
    sides = {f"{side}_{part}" for side in ("left", "right") for part in ("upper_arm", "thigh")}
    assert human == {"head"} | sides
    hand = Hand().body(0.18)
    fingers = limbs_of(hand)
    assert len(fingers) == 5
    assert sum(len(finger.segments) for finger in fingers) == len(hand.skeleton.names) - 1


def test_sampled_joints_keep_the_limits_and_fill_them(random):
    limits = Human().body(1.7).skeleton.limits
    balls, hinges = limits.sampled(random, 400)
    for ball, hinge in zip(balls, hinges, strict=True):
        assert limits.violation(Pose(np.eye(4), ball, hinge)).max() < 1e-9
    spans = hinges.max(axis=0) - hinges.min(axis=0)
    assert (spans > 0.95 * (limits.hinge[:, 1] - limits.hinge[:, 0])).all()


def surface(body: Body, pose: Pose, random: np.random.Generator, count: int = 900) -> np.ndarray:
    """Points on the side of a body's surface that the camera sees."""
    axes = body.capsules.axis_points(0.02)
    chosen = random.integers(len(axes.radii), size=count)
    away = random.normal(size=(count, 3)) - [0.0, 0.0, 0.7]
    away /= np.linalg.norm(away, axis=1, keepdims=True)
    points = axes.place(body.place(pose).transforms)[chosen] + axes.radii[chosen, None] * away
    inside = body.capsules.place(body.place(pose).transforms).surface_distance(points) < -0.005
    return points[~inside & (away[:, 2] < 0.2)]


@pytest.fixture(scope="module")
def raised():
    """A person with an arm raised sideways, and the same with the arm hanging."""
    body = Human().body(1.7)
    root = PoseDescription.model_validate(
        {"root": {"position": [0.0, 0.0, 3.0], "rotation_deg": [180.0, 0.0, 0.0]}}
    )
    hanging = body.skeleton.pose(root)
    arm = PoseDescription(root=root.root, joints={"left_upper_arm": (0.0, 0.0, 100.0)})
    return body, hanging, body.skeleton.pose(arm)


def hand_error(body: Body, pose: Pose, truth: Pose) -> float:
    marker = body.markers.names.index("left_hand")
    places = [body.markers.place(body.place(p).transforms)[marker] for p in (pose, truth)]
    return float(np.linalg.norm(places[0] - places[1]))


def test_limb_search_finds_where_the_arm_is(raised, random):
    body, hanging, truth = raised
    cloud = surface(body, truth, random)
    searches = {s.limb.name: s for s in LimbSearch.of_all(body, random, 500)}
    first = next(searches["left_upper_arm"].starts(cloud, hanging, 1))
    assert hand_error(body, first, truth) < 0.4 * hand_error(body, hanging, truth)
    # All else stays, and where the limb is right nothing else is proposed.
    other = body.markers.names.index("right_hand")
    places = [body.markers.place(body.place(p).transforms)[other] for p in (first, hanging)]
    np.testing.assert_array_equal(places[0], places[1])
    assert not list(searches["right_upper_arm"].starts(cloud, truth, 2))


METHOD = """
name: recovery
dataset: {kind: depth, root: nowhere}
template: human
methods: {method: {preset: PRESET}}
"""


@pytest.mark.parametrize("preset", ["best", "spheres"])
def test_recovery_brings_back_a_lost_arm(raised, random, tmp_path, preset):
    body, hanging, truth = raised
    file = tmp_path / "experiment.yaml"
    file.write_text(METHOD.replace("PRESET", preset))
    registrar = Experiment.read(file).methods["method"].bind(body)
    points = surface(body, truth, random)
    observation = Observation(points, np.ones(len(points)), np.full(len(points), 0.01**2))
    lost = registrar.register(observation, [hanging])
    assert hand_error(body, lost.pose, truth) > 0.4
    recovery = Recovery().bind(registrar)
    found = recovery.checked(observation, lost, Past.start(hanging))
    assert hand_error(body, found.pose, truth) < 0.05
    assert found.inlier_share > lost.inlier_share
