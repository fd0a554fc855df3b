"""Free joints of other segments than the root: several bodies in one skeleton."""

import numpy as np
import pytest
from pydantic import ValidationError

from regkit.body import Body
from regkit.casadi import configuration, forward_kinematics
from regkit.interfaces import Method, Prior, Scene, Term
from regkit.skeleton import Placement, Pose, PoseDescription
from regkit.skeleton.pose import RootDescription
from regkit.system.errors import ConfigError
from tests.support.two_lamps import PLACES, described, lamp, lamps_at, observed


@pytest.fixture
def lamps() -> Body:
    return described().body("lamps", 1.0)


def some_pose(body: Body, random: np.random.Generator) -> Pose:
    bones = body.skeleton
    return bones.limits.projected(bones.retract(bones.rest(), random.normal(size=bones.dofs)))


def test_each_free_segment_has_six_degrees_of_freedom_of_its_own(lamps) -> None:
    bones = lamps.skeleton
    assert not bones.free
    assert bones.dofs == 2 * (6 + 2)
    assert [bones.names[segment] for segment in bones.free_segments] == ["near_foot", "far_foot"]
    moved = bones.dof_mask[bones.joint_dofs["far_foot"]]
    assert {bones.names[one] for one in np.flatnonzero(moved.any(axis=0))} == {
        "far_foot",
        "far_arm",
        "far_head",
    }


def test_a_step_of_a_free_segment_is_one_of_a_free_root(lamps) -> None:
    """Translation in the world first, then a rotation in the segment's own frame."""
    random = np.random.default_rng(0)
    one, two = lamp().body("lamp", 1.0).skeleton, lamps.skeleton
    steps = random.normal(size=(2, one.dofs))
    single, both = one.rest(), two.rest()
    order = np.concatenate([two.joint_dofs[name] for name in ("far_foot", "far_arm", "far_head")])
    for step in steps:
        whole = np.zeros(two.dofs)
        whole[order] = step
        single, both = one.retract(single, step), two.retract(both, whole)
    placed = Placement.of(two, both).transforms[[two.names.index("far_" + n) for n in one.names]]
    np.testing.assert_allclose(placed, Placement.of(one, single).transforms, atol=1e-12)


def test_the_jacobian_is_the_derivative_of_the_placement(lamps) -> None:
    bones, random = lamps.skeleton, np.random.default_rng(1)
    pose = some_pose(lamps, random)
    jacobian, h = Placement.of(bones, pose).jacobian, 1e-6
    for dof in range(bones.dofs):
        step = np.zeros(bones.dofs)
        step[dof] = h
        ends = [
            Placement.of(bones, bones.retract(pose, sign * step)).transforms[:, :3, 3]
            for sign in (-1.0, 1.0)
        ]
        np.testing.assert_allclose(jacobian[:, :3, dof], (ends[1] - ends[0]) / (2 * h), atol=1e-8)


def test_difference_is_the_inverse_of_retract(lamps) -> None:
    bones, random = lamps.skeleton, np.random.default_rng(2)
    start = some_pose(lamps, random)
    step = 0.5 * random.normal(size=bones.dofs)
    np.testing.assert_allclose(bones.difference(start, bones.retract(start, step)), step, atol=1e-9)


def test_symbols_place_the_segments_alike(lamps) -> None:
    pose = some_pose(lamps, np.random.default_rng(3))
    numbers = configuration(lamps.skeleton, pose)
    found = np.array(forward_kinematics(lamps.skeleton)(numbers))
    expected = np.concatenate(list(lamps.place(pose).transforms), axis=1)
    np.testing.assert_allclose(found, expected, atol=1e-12)


def test_a_pose_in_yaml_places_a_free_segment(lamps) -> None:
    bones = lamps.skeleton
    given = RootDescription(position=(1.0, 2.0, 3.0), rotation_deg=(0.0, 90.0, 0.0))
    pose = bones.pose(PoseDescription(joints={"far_foot": given}))
    placed = Placement.of(bones, pose).transforms[bones.names.index("far_foot")]
    np.testing.assert_allclose(placed[:3, 3], [1.0, 2.0, 3.0])
    np.testing.assert_allclose(placed[:3, 0], [0.0, 0.0, -1.0], atol=1e-12)


def test_a_free_segment_takes_no_angles(lamps) -> None:
    with pytest.raises(ConfigError, match="far_foot"):
        lamps.skeleton.pose(PoseDescription(joints={"far_foot": (1.0, 2.0, 3.0)}))


def test_bodies_beside_each_other_are_not_adjacent(lamps) -> None:
    bones = lamps.skeleton
    near, far = bones.names.index("near_foot"), bones.names.index("far_foot")
    assert not bones.adjacent[near, far]
    assert not bones.adjacent[near, 0]
    assert bones.adjacent[near, bones.names.index("near_arm")]


@pytest.mark.parametrize("kind", ["continuity", "motion_prior"])
def test_what_holds_the_joints_leaves_free_bodies_free(lamps, kind: str) -> None:
    bones = lamps.skeleton
    term = Term.parse({"kind": kind}, place="test", field="term")
    method = Method.parse({"preset": "best"}, place="test", field="method")
    primitives = method.shape_model().bind(lamps)
    start = lamps_at(lamps, PLACES)
    step = np.zeros(bones.dofs)
    step[bones.free_dofs] = 0.3
    moved = bones.retract(start, step)
    placed = primitives.place(lamps.place(moved).transforms)
    seen = observed(lamps, moved)
    assert term.bind(Scene(lamps, seen, Prior(start), placed))(moved).energy == pytest.approx(0.0)


def test_two_bodies_are_registered_at_once() -> None:
    """One likelihood makes them compete for the points, and one posterior tells how sure it is."""
    body = described().body("lamps", 1.0)
    bones = body.skeleton
    truth = lamps_at(body, PLACES)
    seen = observed(body, truth)
    step = 0.04 * np.random.default_rng(4).normal(size=bones.dofs)
    start = bones.limits.projected(bones.retract(truth, step))
    registrar = Method.parse({"preset": "best"}, place="test", field="method").bind(body)
    found = registrar.register(seen, [start])
    at_start, at_end, right = (
        body.markers.place(body.place(pose).transforms) for pose in (start, found.pose, truth)
    )
    error = np.linalg.norm(at_end - right, axis=1)
    assert error.max() < 0.02
    assert error.mean() < 0.3 * np.linalg.norm(at_start - right, axis=1).mean()
    assert found.curvature is not None
    assert np.isfinite(found.curvature.covariance(100.0)).all()


def test_poses_spread_in_a_room_are_finite(lamps) -> None:
    bones = lamps.skeleton
    assert np.isfinite(bones.spread).all()
    balls, hinges = bones.limits.sampled(np.random.default_rng(0), 5)
    assert np.isfinite(balls).all()
    assert np.isfinite(hinges).all()


def test_a_root_without_a_joint_is_still_refused() -> None:
    with pytest.raises(ValidationError, match="no joint"):
        lamp().model_validate({**lamp().model_dump(), "segments": {"a": {}}})
