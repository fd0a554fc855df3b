"""Hinges that follow others: declared in the skeleton, held by whatever moves it."""

import numpy as np
import pytest

from regkit.body import Body, BodyDescription
from regkit.body.writing import template_text
from regkit.config.document import Document
from regkit.interfaces import Method, Solver
from regkit.observation import Observation
from regkit.registration import COORDINATES
from regkit.skeleton import Pose, PoseDescription
from regkit.system.errors import ConfigError
from regkit_synthesis.templates import mirror

FINGER = """
title: A finger whose last joint follows the middle one.
size: {name: length, value: 1.0, range: [0.5, 2.0]}
segments:
  palm: {joint: {type: free}}
  first:
    parent: palm
    offset: [0, 0.4, 0]
    joint: {type: ball, swing_deg: [60, 40], twist_deg: [-20, 20]}
  last:
    parent: middle
    offset: [0, 0.2, 0]
    joint: {type: hinge, axis: x, limits_deg: [0, 40],
            coupled: {to: middle, ratio: 0.5, offset_deg: 5}}
    capsules: [{start: [0, 0, 0], end: [0, 0.1, 0], radius: 0.02}]
  middle:
    parent: first
    offset: [0, 0.3, 0]
    joint: {type: hinge, axis: [1, 0, 0.2], limits_deg: [-20, 110]}
    capsules: [{start: [0, 0, 0], end: [0, 0.2, 0], radius: 0.03}]
  thumb:
    parent: palm
    offset: [0.2, 0, 0]
    joint: {type: hinge, axis: z, limits_deg: [-30, 30]}
"""


def written(tmp_path, text: str) -> BodyDescription:
    path = tmp_path / "finger.yaml"
    path.write_text(text)
    return Document.read(path).validated(BodyDescription)


@pytest.fixture
def finger(tmp_path) -> Body:
    return written(tmp_path, FINGER).body("finger", 1.0)


def follows(body: Body, pose: Pose) -> bool:
    leader, follower = (
        body.skeleton.joint_dofs[name][0] - body.skeleton.hinge_dofs.start
        for name in ("middle", "last")
    )
    expected = 0.5 * pose.hinges[leader] + np.radians(5.0)
    return bool(abs(pose.hinges[follower] - expected) < 1e-12)


@pytest.mark.parametrize("name", list(COORDINATES))
def test_coordinates_move_the_follower_with_its_leader(finger, random, name):
    bones = finger.skeleton
    coordinates = COORDINATES[name](bones, bones.rest())
    x = coordinates.origin() + 0.3 * random.normal(size=len(coordinates.origin()))
    assert follows(finger, coordinates.pose(coordinates.origin()))
    assert follows(finger, coordinates.pose(x))
    np.testing.assert_allclose(coordinates.vector(bones.rest()), coordinates.origin(), atol=1e-12)
    back = coordinates.pose(coordinates.vector(coordinates.pose(x)))
    np.testing.assert_allclose(back.hinges, coordinates.pose(x).hinges, atol=1e-9)


@pytest.mark.parametrize("name", list(COORDINATES))
def test_differential_holds_with_a_follower(finger, random, name):
    bones = finger.skeleton
    coordinates = COORDINATES[name](bones, bones.rest())
    x = coordinates.origin() + 0.3 * random.normal(size=len(coordinates.origin()))
    jacobian = coordinates.jacobian(x)
    assert jacobian.shape == (bones.dofs, len(x))
    step = 1e-6
    for column, direction in zip(jacobian.T, np.eye(len(x)), strict=True):
        ahead, behind = (
            coordinates.pose(x + step * direction),
            coordinates.pose(x - step * direction),
        )
        moved = bones.difference(behind, ahead) / (2.0 * step)
        # The root's rotation and the balls turn in the frame at x, as ``difference`` does.
        np.testing.assert_allclose(column, moved, atol=1e-7)


def test_leader_keeps_the_limits_of_its_follower_too(finger):
    bones = finger.skeleton
    # The last joint bends by 40 degrees at most, so the middle one by 70; it is never below -10.
    coordinates = COORDINATES["tangent"](bones, bones.rest())
    lower, upper = coordinates.bounds()
    leader = bones.joint_dofs["middle"][0]
    independent = np.delete(np.arange(bones.dofs), bones.joint_dofs["last"])
    at = list(independent).index(leader)
    np.testing.assert_allclose(np.degrees([lower[at], upper[at]]), [-10.0, 70.0])


def test_projection_and_samples_keep_the_coupling(finger, random):
    bones = finger.skeleton
    for _ in range(20):
        pose = bones.retract(bones.rest(), 2.0 * random.normal(size=bones.dofs))
        projected = bones.limits.projected(pose)
        assert follows(finger, projected)
        assert bones.limits.violation(projected).max() < 1e-9
    balls, hinges = bones.limits.sampled(random, 50)
    for ball, hinge in zip(balls, hinges, strict=True):
        assert bones.limits.violation(Pose(np.eye(4), ball, hinge)).max() < 1e-6


def test_violation_says_how_far_a_follower_is_off(finger):
    bones = finger.skeleton
    step = np.zeros(bones.dofs)
    step[bones.joint_dofs["last"]] = np.radians(3.0)
    violation = bones.limits.violation(bones.retract(bones.rest(), step))
    np.testing.assert_allclose(np.degrees(violation.max()), 3.0)


def test_pose_leaves_the_follower_out(finger):
    bones = finger.skeleton
    assert follows(finger, bones.pose(PoseDescription(joints={"middle": 30.0})))
    with pytest.raises(ConfigError, match=r"'last' is coupled.*leave"):
        bones.pose(PoseDescription(joints={"last": 30.0}))


def test_coupling_is_written_and_read_again(tmp_path):
    description = written(tmp_path, FINGER)
    again = written(tmp_path, template_text(description, "", {}))
    assert again.segments["last"].joint.coupled == description.segments["last"].joint.coupled


@pytest.mark.parametrize("ratio", [0.5, -0.5])
def test_leader_is_narrowed_by_either_sign_of_the_ratio(tmp_path, ratio):
    text = FINGER.replace("ratio: 0.5", f"ratio: {ratio}").replace("[0, 40]", "[-40, 40]")
    limits = written(tmp_path, text).body("finger", 1.0).skeleton.limits
    leader, follower = (
        limits.couplings.leaders[0], limits.couplings.followers[0]
    )  # fmt: skip
    for end in limits.hinge[leader]:
        angle = np.degrees(ratio * end) + 5.0
        assert -40.0 - 1e-9 <= angle <= 40.0 + 1e-9
    assert limits.hinge[leader, 0] < limits.hinge[leader, 1]
    np.testing.assert_allclose(np.degrees(limits.hinge[follower]), [-40.0, 40.0])


def test_followers_that_contradict_one_another_are_refused(tmp_path):
    other = (
        "  other:\n    parent: palm\n    joint: {type: hinge, axis: y, limits_deg: [80, 90], "
        "coupled: {to: middle, ratio: 1.0}}\n"
    )
    with pytest.raises(ConfigError, match=r"no position of 'middle' .*'other' needs"):
        written(tmp_path, FINGER + other)


def test_mirrored_follower_follows_the_mirrored_leader(tmp_path):
    right = written(tmp_path, FINGER).segments["last"]
    left = mirror.segment(right, lambda name: f"left_{name}")
    assert left.parent == "left_middle"
    assert left.joint.coupled.to == "left_middle"


@pytest.mark.parametrize("solver", list(Solver.available()))
def test_every_solver_holds_a_coupling(finger, random, solver):
    bones = finger.skeleton
    method = Method.load("direct")(shape="gsog", kernel="likelihood", solver=solver)
    registrar = method.bind(finger)
    target = bones.limits.projected(
        bones.retract(bones.rest(), 0.4 * random.normal(size=bones.dofs))
    )
    placed = registrar.primitives.place(finger.place(target).transforms)
    chosen = random.integers(len(placed), size=200)
    points = placed.centres[chosen] + 0.02 * random.normal(size=(200, 3))
    data = Observation(points, np.ones(200), np.full(200, 1e-4))
    uncoupled = bones.retract(target, 0.05 * random.normal(size=bones.dofs))
    found = registrar.register(data, [uncoupled])
    assert follows(finger, found.pose)
    assert registrar.evaluate(data, found.pose).energy < registrar.evaluate(data, uncoupled).energy


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("to: middle", "to: midle"), "did you mean 'middle'?"),
        (("to: middle", "to: first"), "'first' is not a hinge; 'last' can follow"),
        (("to: middle", "to: last"), "a hinge cannot follow itself"),
        (("ratio: 0.5", "ratio: 0"), "must be at least 0.001"),
        (("limits_deg: [0, 40]", "limits_deg: [70, 80]"), "between 130 and 150 degrees"),
    ],
)
def test_coupling_that_cannot_be_is_refused_at_its_line(tmp_path, change, message):
    with pytest.raises(ConfigError, match=r"finger\.yaml:14") as caught:
        written(tmp_path, FINGER.replace(*change))
    assert message in str(caught.value)
