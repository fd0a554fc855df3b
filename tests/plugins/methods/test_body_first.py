"""The body first, then its parts: what is registered, what is held, and how sure it is."""

import numpy as np
import pytest

from regkit.body import Body
from regkit.body.lifting import Lifting
from regkit.geometry.rigid import rigid
from regkit.interfaces import Method, Prior
from regkit.observation import Observation, View
from regkit.skeleton import Pose
from regkit_plugins.methods.body_first.fineness import Nearness, thinned_elsewhere
from tests.support.scarecrow import measured, scarecrow, standing
from tests.support.two_lamps import lamp


@pytest.fixture(scope="module")
def body() -> Body:
    return scarecrow()


def method(**fields: object) -> Method:
    return Method.parse({"kind": "body_first", **fields}, place="test", field="method")


def errors(body: Body, found: Pose, truth: Pose) -> dict[str, float]:
    places = [body.markers.place(body.place(pose).transforms) for pose in (found, truth)]
    distances = np.linalg.norm(places[0] - places[1], axis=1)
    return dict(zip(body.markers.names, distances.tolist(), strict=True))


def test_lowering_and_lifting_are_inverse(body) -> None:
    lifting = Lifting.of(body)
    assert lifting is not None
    pose = standing(body, arm=30, hand=20, hand_thumb=-20, hand_finger=10)
    lowered = lifting.lowered(pose)
    back = lifting.lifted(lowered, pose)
    np.testing.assert_array_equal(back.hinges, pose.hinges)
    base = lifting.base.place(lowered).transforms
    whole = body.place(pose).transforms
    for name in ("pole", "arm"):
        np.testing.assert_allclose(
            base[lifting.base.skeleton.names.index(name)],
            whole[body.skeleton.names.index(name)],
            atol=1e-12,
        )


def test_the_dofs_of_a_base_are_those_of_the_whole(body) -> None:
    """A step of the base is the same step of the whole."""
    lifting = Lifting.of(body)
    assert lifting is not None
    pose = standing(body, arm=30, hand=20)
    step = 0.1 * np.random.default_rng(0).normal(size=lifting.base.skeleton.dofs)
    whole = np.zeros(body.skeleton.dofs)
    whole[lifting.dofs] = step
    moved = lifting.lowered(body.skeleton.retract(pose, whole))
    alone = lifting.base.skeleton.retract(lifting.lowered(pose), step)
    np.testing.assert_allclose(moved.root, alone.root, atol=1e-12)
    np.testing.assert_allclose(moved.hinges, alone.hinges, atol=1e-12)


def test_a_part_in_view_is_registered_with_the_body(body) -> None:
    truth = standing(body, arm=25, hand=15, hand_thumb=-25, hand_finger=20)
    start = standing(body, arm=20, hand=10, hand_thumb=-15, hand_finger=12)
    found = method().bind(body).register(measured(body, truth), [start])
    before, after = errors(body, start, truth), errors(body, found.pose, truth)
    for tip in ("hand_thumb_tip", "hand_finger_tip"):
        assert after[tip] < 0.012
        assert after[tip] < 0.3 * before[tip]
    assert after["elbow"] < 0.012


def test_a_part_with_few_data_keeps_its_joints(body) -> None:
    """The base moves onto the data, and nothing is known of the joints of the part."""
    bones = body.skeleton
    truth = standing(body, arm=25, hand=15, hand_thumb=-25, hand_finger=20)
    start = standing(body, arm=18, hand=5, hand_thumb=-5, hand_finger=3)
    registrar = method(least_points=1_000_000).bind(body)
    found = registrar.register(measured(body, truth), [start], prior=Prior(start))
    hand = body.parts[1].dofs
    step = bones.difference(start, found.pose)
    np.testing.assert_array_equal(step[hand], 0.0)
    assert np.abs(step).max() > 0.05
    assert found.curvature is not None
    covariance = found.curvature.covariance(100.0)
    arm = bones.joint_dofs["arm"]
    assert covariance[arm, arm] < 0.05 * bones.spread[arm, arm]
    np.testing.assert_allclose(
        covariance[np.ix_(hand, hand)], bones.spread[np.ix_(hand, hand)], rtol=1e-6
    )


def test_a_filter_holds_what_it_knows_of_a_part_without_data(body) -> None:
    bones = body.skeleton
    truth, start = standing(body, arm=25), standing(body, arm=20)
    information = np.diag(np.full(bones.dofs, 50.0))
    prior = Prior(start, information, 100.0)
    settings = {"method": {"preset": "filtered"}, "least_points": 1_000_000}
    found = method(**settings).bind(body).register(measured(body, truth), [start], prior=prior)
    assert found.curvature is not None
    covariance = found.curvature.covariance(100.0)
    hand = body.parts[1].dofs
    np.testing.assert_allclose(np.diag(covariance)[hand], 1.0 / 50.0, rtol=1e-6)
    assert (np.linalg.eigvalsh(covariance) > 0.0).all()


def test_data_are_fine_near_the_parts_alone(body) -> None:
    pose = standing(body, arm=25)
    seen = measured(body, pose)
    near = Nearness.of(body, pose, seen.points, 0.35)
    hand = np.isin(body.capsules.segments, body.parts[1].segments)
    surface = body.capsules.selected(hand).place(body.place(pose).transforms)
    expected = surface.surface_distance(seen.points) <= 0.35 * body.parts[1].size
    np.testing.assert_array_equal(near.points, expected)
    assert 20 < near.most < near.points.sum()
    mixed = thinned_elsewhere(seen, near.points, 0.05)
    kept = {tuple(point) for point in mixed.points}
    assert {tuple(point) for point in seen.points[near.points]} <= kept
    assert len(mixed.points) < 0.5 * len(seen.points) + near.points.sum()


def test_points_of_the_body_behind_a_part_are_not_the_parts(body) -> None:
    """A hand before the pole is near to many points, most of which are the pole's."""
    pose = standing(body, arm=80)
    points = np.random.default_rng(0).normal(size=(400, 3)) * [0.02, 0.2, 0.02]
    at = body.place(pose).transforms[body.skeleton.names.index("arm"), :3]
    placed = points @ at[:, :3].T + at[:, 3]
    assert Nearness.of(body, pose, placed, 5.0).points.all()
    assert Nearness.of(body, pose, placed, 5.0).most < 100


def test_a_body_without_parts_is_registered_by_the_method_alone() -> None:
    alone = lamp().body("lamp", 1.0)
    own = Method.parse("best", place="test", field="method").bind(alone)
    assert type(method().bind(alone)) is type(own)


def test_data_of_several_cameras_are_thinned_in_each(body) -> None:
    pose = standing(body, arm=25)
    seen = measured(body, pose)
    aside = rigid(np.eye(3), np.array([0.3, 0.0, 0.0]))
    both = Observation.of_views([View("one", np.eye(4), seen), View("two", aside, seen)])
    near = Nearness.of(body, pose, both.points, 0.35)
    mixed = thinned_elsewhere(both, near.points, 0.05)
    assert [view.name for view in mixed.views] == ["one", "two"]
    own = thinned_elsewhere(seen, near.points[: len(seen.points)], 0.05)
    np.testing.assert_array_equal(mixed.views[0].data.points, own.points)
    assert len(mixed.points) == sum(len(view.data.points) for view in mixed.views)
    found = method().bind(body).register(both, [pose])
    assert found.pose.hinges.shape == pose.hinges.shape
