"""The CasADi functions say the same as the arrays do, with exact derivatives and without NaN."""

import casadi
import numpy as np
import pytest

from regkit import casadi as symbolic
from regkit.body import Body
from regkit.geometry.rotation import from_vector, product, vector_to_matrix
from regkit.interfaces import Kernel, ShapeModel, Template
from regkit.observation import Observation
from regkit.skeleton import Pose, SegmentDescription, SkeletonDescription
from regkit.skeleton.compile import compiled
from regkit.skeleton.joints import BallJoint, FreeJoint


@pytest.fixture(params=["linkage", "human", "hand"])
def body(request: pytest.FixtureRequest, linkage: Body) -> Body:
    if request.param == "linkage":
        return linkage
    return Template.load(request.param)().body({"human": 1.7, "hand": 0.18}[request.param])


def posed(body: Body, random: np.random.Generator, size: float = 0.7) -> Pose:
    bones = body.skeleton
    return bones.retract(bones.rest(), size * random.normal(size=bones.dofs))


def numbers_of(body: Body, pose: Pose) -> np.ndarray:
    return symbolic.configuration(body.skeleton, pose)


def differences(function: casadi.Function, numbers: np.ndarray) -> np.ndarray:
    """The derivative of a function by central differences."""
    step = 1e-6
    columns = [
        (function(numbers + step * e).full() - function(numbers - step * e).full()) / (2.0 * step)
        for e in np.eye(len(numbers))
    ]
    return np.concatenate(columns, axis=1)


def jacobian(function: casadi.Function, numbers: np.ndarray) -> np.ndarray:
    at = casadi.SX.sym("at", len(numbers))
    return casadi.Function("slope", [at], [casadi.jacobian(function(at), at)])(numbers).full()


def test_configuration_holds_a_pose(body, random):
    pose = posed(body, random)
    again = symbolic.pose_of(body.skeleton, numbers_of(body, pose))
    np.testing.assert_allclose(
        body.place(again).transforms, body.place(pose).transforms, atol=1e-12
    )


def test_forward_kinematics_is_place(body, random):
    for _ in range(5):
        pose = posed(body, random)
        found = symbolic.forward_kinematics(body.skeleton)(numbers_of(body, pose)).full()
        expected = np.hstack(body.place(pose).transforms)
        np.testing.assert_allclose(found, expected, atol=1e-12)


def test_marker_positions_are_those_of_the_body(body, random):
    pose = posed(body, random)
    found = symbolic.marker_positions(body.skeleton, body.markers)(numbers_of(body, pose)).full()
    np.testing.assert_allclose(found.T, body.markers.place(body.place(pose).transforms), atol=1e-12)


def test_retract_is_that_of_the_skeleton(body, random):
    pose, bones = posed(body, random), body.skeleton
    step = random.normal(size=bones.dofs)
    moved = symbolic.retract(bones)(numbers_of(body, pose), step).full().ravel()
    expected = body.place(bones.retract(pose, step)).transforms
    found = body.place(symbolic.pose_of(bones, moved)).transforms
    np.testing.assert_allclose(found, expected, atol=1e-12)


def test_limit_rows_are_broken_where_limits_are(body, random):
    rows = symbolic.joint_limits(body.skeleton)
    owners = [*body.skeleton.joint_dofs]
    assert {name.split(".")[0] for name in rows.names} <= set(owners)
    for _ in range(200):
        pose = posed(body, random, size=random.uniform(0.1, 1.5))
        values = rows.function(numbers_of(body, pose)).full().ravel()
        beyond = np.maximum(rows.lower - values, values - rows.upper)
        violation = body.skeleton.limits.violation(pose)
        assert (beyond.max() > 0.0) == (violation.max() > 0.0)
        # A row is at least the violation in radians, so that keeping it keeps the limit. It counts
        # a twist the shorter way round to its interval; the other way is this long.
        twists = body.skeleton.limits.twist
        other_way = 2.0 * np.pi - np.ptp(twists, axis=1) - violation[: len(twists)]
        violation[: len(twists)] = np.minimum(violation[: len(twists)], other_way)
        assert max(beyond.max(), 0.0) >= violation.max() - 1e-9


def test_twist_rows_are_angles(linkage):
    bones = linkage.skeleton
    rows = symbolic.ball_limits(bones)
    assert rows.names == ("arm.swing", "arm.twist")
    for degrees in (-170.0, -45.0, 0.0, 60.0, 179.0):
        axis = bones.limits.twist_axis[0]
        balls = bones.rest().balls.copy()
        balls[0] = product(
            from_vector(np.array([0.3, 0.0, 0.2])), from_vector(np.radians(degrees) * axis)
        )
        for sign in (1.0, -1.0):
            pose = Pose(np.eye(4), sign * balls, bones.rest().hinges)
            swing, twist = rows.function(numbers_of(linkage, pose)).full().ravel()
            assert np.degrees(twist) == pytest.approx(degrees, abs=1e-9)
            assert swing < 0.0


def test_derivatives_are_exact(body, random):
    rows = symbolic.joint_limits(body.skeleton)
    for _ in range(5):
        numbers = numbers_of(body, posed(body, random))
        np.testing.assert_allclose(
            jacobian(rows.function, numbers), differences(rows.function, numbers), atol=1e-7
        )


def awkward(body: Body) -> list[Pose]:
    """No rotation, the middle and the edge of each cone, half turns of twist and of swing."""
    bones, rest = body.skeleton, body.skeleton.rest()
    limits = bones.limits
    half = np.where(np.isfinite(limits.swing), limits.swing, np.pi)[:, :1]
    turns = [
        np.zeros_like(limits.twist_axis),
        half * limits.swing_axis,
        np.pi * limits.twist_axis,
        np.pi * limits.swing_axis,
        1e-9 * limits.swing_axis + 1e-9 * limits.twist_axis,
        1e-2 * limits.swing_axis,
    ]
    poses = [
        Pose(rest.root, product(limits.centre, from_vector(turn)), rest.hinges) for turn in turns
    ]
    edge_and_half_a_twist = product(from_vector(turns[1]), from_vector(turns[2]))
    return [
        rest,
        *poses,
        Pose(rest.root, product(limits.centre, edge_and_half_a_twist), rest.hinges),
    ]


def test_nothing_is_nan_at_awkward_poses(body):
    rows = symbolic.joint_limits(body.skeleton)
    at = casadi.SX.sym("at", rows.function.size1_in(0))
    multipliers = casadi.SX.sym("multipliers", len(rows))
    curvature = casadi.hessian(casadi.dot(multipliers, rows.function(at)), at)[0]
    everything = casadi.Function(
        "everything",
        [at, multipliers],
        [rows.function(at), casadi.jacobian(rows.function(at), at), curvature],
    )
    for pose in awkward(body):
        for value in everything(numbers_of(body, pose), np.ones(len(rows))):
            assert np.isfinite(value.full()).all()


@pytest.mark.parametrize("kind", ["sog", "gsog"])
def test_correlation_is_that_of_the_kernel(linkage, random, kind):
    shape = ShapeModel.load(kind)()
    gaussians = shape.bind(linkage)
    pose = posed(linkage, random)
    points = linkage.markers.place(linkage.place(pose).transforms)[random.integers(0, 3, 40)]
    points = points + 0.1 * random.normal(size=points.shape)
    weights, variances = random.uniform(0.5, 2.0, 40), random.uniform(0.01, 0.03, 40) ** 2
    placed = gaussians.place(linkage.place(pose).transforms)
    kernel = Kernel.load("correlation")()
    expected = kernel.bind(Observation(points, weights, variances, None), placed)(placed).energy
    function = symbolic.correlation(linkage.skeleton, gaussians, 40)
    numbers = numbers_of(linkage, pose)
    assert float(function(numbers, points.T, weights, variances)) == pytest.approx(
        expected, rel=1e-10
    )
    at = casadi.MX.sym("at", len(numbers))
    energy = casadi.Function("energy", [at], [function(at, points.T, weights, variances)])
    slope = casadi.Function("slope", [at], [casadi.gradient(energy(at), at)])(numbers).full().T
    np.testing.assert_allclose(slope, differences(energy, numbers), atol=1e-7)


def test_rows_projection_and_violation_mean_the_same_limits(random):
    """Whatever the axes, the cone and the twist's interval, as long as it is within half a turn."""
    for _ in range(40):
        twist_axis, swing_axis, _ = vector_to_matrix(2.0 * random.normal(size=3))
        ball = BallJoint(
            type="ball",
            twist_axis=tuple(twist_axis),
            swing_axis=tuple(swing_axis),
            centre_deg=tuple(random.uniform(-120.0, 120.0, 3)),
            swing_deg=tuple(random.uniform(10.0, 180.0, 2)),
            twist_deg=tuple(np.sort(random.uniform(-180.0, 180.0, 2))),
        )
        segments = {
            "base": SegmentDescription(joint=FreeJoint()),
            "arm": SegmentDescription(parent="base", joint=ball),
        }
        bones = compiled(SkeletonDescription(segments=segments))
        rows = symbolic.ball_limits(bones)
        for _ in range(20):
            turn = from_vector(2.0 * random.normal(size=(1, 3)))
            pose = Pose(np.eye(4), turn, np.zeros(0))
            within = bones.limits.projected(pose)
            values = rows.function(symbolic.configuration(bones, pose)).full().ravel()
            beyond = np.maximum(rows.lower - values, values - rows.upper).max()
            violation = bones.limits.violation(pose).max()
            assert (beyond > 1e-9) == (violation > 1e-9)
            values = rows.function(symbolic.configuration(bones, within)).full().ravel()
            assert np.maximum(rows.lower - values, values - rows.upper).max() < 1e-8
            assert bones.limits.violation(within).max() < 1e-8
