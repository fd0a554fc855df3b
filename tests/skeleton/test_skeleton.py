"""The laws of kinematics, on a linkage with every type of joint."""

import numpy as np
import pytest

from regkit.body import Body, BodyDescription
from regkit.config.document import Document
from regkit.geometry.rigid import inverse, log, rigid
from regkit.geometry.rotation import from_vector, vector_to_matrix
from regkit.registration import COORDINATES
from regkit.skeleton import Pose, PoseDescription
from regkit.system.errors import ConfigError


def random_pose(body: Body, random: np.random.Generator, size: float = 0.7) -> Pose:
    bones = body.skeleton
    return bones.retract(bones.rest(), size * random.normal(size=bones.dofs))


def test_degrees_of_freedom_are_counted(linkage):
    assert linkage.skeleton.dofs == 6 + 2 * 3 + 1 + 2


def test_place_follows_a_common_motion(linkage, random):
    pose = random_pose(linkage, random)
    motion = rigid(vector_to_matrix(random.normal(size=3)), random.normal(size=3))
    moved = Pose(motion @ pose.root, pose.balls, pose.hinges)
    np.testing.assert_allclose(
        linkage.place(moved).transforms, motion @ linkage.place(pose).transforms, atol=1e-13
    )


def test_fixed_segment_moves_with_its_parent(linkage, random):
    names = linkage.skeleton.names
    wrist, plate = names.index("wrist"), names.index("plate")
    relative = [
        inverse(transforms[wrist]) @ transforms[plate]
        for transforms in (
            linkage.place(linkage.skeleton.rest()).transforms,
            linkage.place(random_pose(linkage, random)).transforms,
        )
    ]
    np.testing.assert_allclose(relative[0], relative[1], atol=1e-13)


def test_hinge_turns_about_its_axis(linkage):
    bones = linkage.skeleton
    pose = bones.pose(PoseDescription(joints={"forearm": 30.0}))
    names = bones.names
    arm, forearm = (linkage.place(pose).transforms[names.index(n)] for n in ("arm", "forearm"))
    rest = vector_to_matrix(np.radians([20.0, 0.0, 30.0]))
    turn = rest.T @ (arm[:3, :3].T @ forearm[:3, :3])
    expected = vector_to_matrix(np.radians(30.0) * np.array([1.0, 1.0, 0.0]) / np.sqrt(2.0))
    np.testing.assert_allclose(turn, expected, atol=1e-13)


def test_universal_joint_turns_the_second_axis_with_the_first(linkage):
    bones = linkage.skeleton
    pose = bones.pose(PoseDescription(joints={"wrist": (40.0, 15.0)}))
    names = bones.names
    forearm, wrist = (linkage.place(pose).transforms[names.index(n)] for n in ("forearm", "wrist"))
    first = vector_to_matrix(np.radians([40.0, 0.0, 0.0]))
    second = vector_to_matrix(np.radians([0.0, 0.0, 15.0]))
    np.testing.assert_allclose(forearm[:3, :3].T @ wrist[:3, :3], first @ second, atol=1e-13)


def test_jacobian_is_the_derivative_of_place(linkage, random):
    bones = linkage.skeleton
    pose = random_pose(linkage, random)
    jacobian = linkage.place(pose).jacobian
    step = 1e-6
    for column, direction in enumerate(np.eye(bones.dofs)):
        ahead = linkage.place(bones.retract(pose, step * direction)).transforms
        behind = linkage.place(bones.retract(pose, -step * direction)).transforms
        linear = (ahead - behind)[:, :3, 3] / (2 * step)
        turn = log(rigid(ahead[:, :3, :3] @ np.swapaxes(behind[:, :3, :3], 1, 2), np.zeros(3)))
        angular = turn[:, 3:] / (2 * step)
        expected = np.concatenate([linear, angular], axis=1)
        np.testing.assert_allclose(jacobian[:, :, column], expected, atol=1e-8)


def test_pull_back_is_the_transposed_jacobian(linkage, random):
    placement = linkage.place(random_pose(linkage, random))
    wrenches = random.normal(size=(len(linkage.skeleton.names), 6))
    expected = np.einsum("sin,si->n", placement.jacobian, wrenches)
    np.testing.assert_allclose(placement.jacobian_transpose(wrenches), expected, atol=1e-12)


def test_normal_matrix_sums_the_blocks(linkage, random):
    placement = linkage.place(random_pose(linkage, random))
    factors = random.normal(size=(len(linkage.skeleton.names), 6, 6))
    stiffness = factors @ np.swapaxes(factors, 1, 2)
    jacobian = placement.jacobian
    expected = np.einsum("sin,sij,sjm->nm", jacobian, stiffness, jacobian)
    np.testing.assert_allclose(placement.normal_matrix(stiffness), expected, atol=1e-10)


@pytest.mark.parametrize("name", COORDINATES)
def test_coordinates_start_at_the_start(linkage, random, name):
    start = random_pose(linkage, random)
    coordinates = COORDINATES[name](linkage.skeleton, start)
    pose = coordinates.pose(coordinates.origin())
    np.testing.assert_allclose(
        linkage.place(pose).transforms, linkage.place(start).transforms, atol=1e-12
    )


def test_quaternion_coordinates_have_four_numbers_for_each_rotation(linkage):
    coordinates = COORDINATES["quaternion"](linkage.skeleton, linkage.skeleton.rest())
    rotations, hinges = 3, 3  # The root and two balls; one hinge and a universal joint.
    assert len(coordinates.origin()) == 4 * rotations + 3 + hinges


@pytest.mark.parametrize("name", COORDINATES)
def test_bounds_hold_the_hinge_limits_and_the_start(linkage, name):
    bones = linkage.skeleton
    start = bones.pose(PoseDescription(joints={"forearm": 100.0}))
    coordinates = COORDINATES[name](bones, start)
    lower, upper = coordinates.bounds()
    origin = coordinates.origin()
    assert (lower <= origin).all()
    assert (origin <= upper).all()
    for bound, index in ((lower, 0), (upper, 1)):
        x = origin.copy()
        x[-3:] = bound[-3:]
        np.testing.assert_allclose(coordinates.pose(x).hinges, bones.limits.hinge[:, index])


def test_violation_is_zero_inside_and_grows_outside(linkage):
    bones = linkage.skeleton
    inside = bones.pose(PoseDescription(joints={"arm": (50.0, 0.0, 0.0), "forearm": 139.0}))
    assert bones.limits.violation(inside).max() == 0.0
    outside = bones.pose(
        PoseDescription(joints={"arm": (70.0, 0.0, 0.0), "forearm": -30.0, "wrist": (0.0, 25.0)})
    )
    violation = np.degrees(bones.limits.violation(outside))
    np.testing.assert_allclose(violation, [10.0, 0.0, 20.0, 0.0, 5.0], atol=1e-9)


def test_violation_of_twist(linkage):
    bones = linkage.skeleton
    twisted = bones.pose(PoseDescription(joints={"arm": (0.0, 60.0, 0.0)}))
    np.testing.assert_allclose(np.degrees(bones.limits.violation(twisted))[0], 15.0, atol=1e-9)


def test_swing_cone_is_elliptic_and_swing_twist_free(linkage):
    """A swing about the second axis may be larger, and a twist added does not change it."""
    bones = linkage.skeleton
    rest = bones.rest()
    swing, twist = (
        from_vector(np.radians([0.0, 0.0, 85.0])),
        from_vector(np.radians([0.0, 40.0, 0])),
    )
    from regkit.geometry.rotation import product

    balls = rest.balls.copy()
    balls[0] = product(swing, twist)
    assert bones.limits.violation(Pose(rest.root, balls, rest.hinges)).max() == 0.0


def test_projection_keeps_the_limits_and_what_keeps_them(linkage, random):
    bones = linkage.skeleton
    inside = bones.pose(PoseDescription(joints={"arm": (30.0, 10.0, 0.0), "forearm": 100.0}))
    assert bones.limits.projected(inside) is inside
    for _ in range(50):
        pose = random_pose(linkage, random, size=2.0)
        projected = bones.limits.projected(pose)
        assert bones.limits.violation(projected).max() < 1e-9
        np.testing.assert_array_equal(projected.root, pose.root)


def test_difference_is_the_step_that_retract_takes(linkage, random):
    bones = linkage.skeleton
    start, end = random_pose(linkage, random), random_pose(linkage, random)
    reached = bones.retract(start, bones.difference(start, end))
    np.testing.assert_allclose(
        linkage.place(reached).transforms, linkage.place(end).transforms, atol=1e-12
    )


def test_twist_beyond_half_a_turn_is_refused(linkage_text, tmp_path):
    path = tmp_path / "linkage.yaml"
    path.write_text(linkage_text.replace("twist_deg: [-45, 45]", "twist_deg: [20, 300]"))
    with pytest.raises(ConfigError, match=r"twist_deg.*-180 and 180 degrees"):
        Document.read(path).validated(BodyDescription)


def test_names_of_joints_stand_in_the_order_of_their_angles(linkage):
    """Each angle moves the segment of its name, and no other joint."""
    bones = linkage.skeleton
    assert len(bones.ball_names) == len(bones.ball_links)
    assert len(set(bones.hinge_names)) == len(bones.hinge_links)
    for index, name in enumerate(bones.hinge_names):
        segment, _, which = name.partition(".")
        dofs = bones.joint_dofs[segment] - bones.hinge_dofs.start
        assert index == dofs[("", "first", "second").index(which) - 1 if which else 0]
        assert (len(dofs) == 2) is bool(which)
    for index, name in enumerate(bones.ball_names):
        assert bones.joint_dofs[name][0] == bones.ball_dofs.start + 3 * index
