"""The covariance of a registered pose agrees with what noise does to it, and keeps the limits."""

from dataclasses import replace

import numpy as np
import pytest

from regkit.body import BodyDescription
from regkit.config.document import Document
from regkit.geometry.rigid import rigid
from regkit.interfaces import Method, Prior
from regkit.observation import Observation
from regkit.registration import effective_points, marker_covariances
from regkit.registration.compiled_posterior import inverted
from regkit.skeleton.spread import spread_variances

SPREAD = """
title: Parts that lie apart, so that each point has one owner.
size: {name: length, value: 1.0, range: [0.5, 2.0]}
segments:
  base:
    joint: {type: free}
    capsules: [{start: [0, 0, 0], end: [0, 0.2, 0], radius: 0.03}]
  side:
    parent: base
    joint: {type: fixed}
    capsules: [{start: [0.4, 0.1, 0], end: [0.4, 0.1, 0.2], radius: 0.03}]
  arm:
    parent: base
    offset: [0, 0.5, 0]
    joint: {type: ball}
    capsules: [{start: [0, 0.2, 0], end: [0, 0.4, 0], radius: [0.03, 0.02]}]
  wing:
    parent: arm
    joint: {type: fixed}
    capsules: [{start: [0.3, 0.3, 0], end: [0.5, 0.3, 0.1], radius: 0.03}]
  finger:
    parent: arm
    offset: [0, 0.6, 0]
    joint: {type: hinge, axis: x, limits_deg: [-60, 60]}
    capsules: [{start: [0, 0.2, 0], end: [0, 0.4, 0], radius: 0.02}]
    markers: {middle: [0, 0.4, 0]}
  tip:
    parent: finger
    offset: [0, 0.6, 0]
    joint: {type: hinge, axis: x, coupled: {to: finger, ratio: 0.5}}
    capsules: [{start: [0, 0.2, 0], end: [0, 0.4, 0], radius: 0.02}]
    markers: {end: [0, 0.4, 0]}
"""
VARIANCE = 1e-6


@pytest.fixture(scope="module")
def body(tmp_path_factory):
    file = tmp_path_factory.mktemp("posterior") / "spread.yaml"
    file.write_text(SPREAD)
    return Document.read(file).validated(BodyDescription).body("spread", 1.0)


def method(**fields):
    config = {
        "kind": "direct",
        "shape": {"kind": "gsog", "surface": "volume"},
        "kernel": {"kind": "likelihood", "outliers": 1e-6},
        "solver": {"kind": "gauss_newton", "max_iterations": 20, "value_tolerance": 1e-9},
    }
    return Method.parse({**config, **fields}, place="test", field="method")


def pose_of(body, degrees):
    bones = body.skeleton
    turned = bones.retract(bones.rest(rigid(np.eye(3), np.array([0.1, 0.2, 2.0]))), np.zeros(11))
    step = np.zeros(bones.dofs)
    step[bones.dofs_of("finger")] = np.radians(degrees)
    step[6:9] = 0.3, -0.2, 0.4
    return bones.limits.hinged(bones.retract(turned, step))


def drawn(registrar, pose, random, each=60):
    """Independent points of all Gaussians."""
    placed = registrar.primitives.place(registrar.body.place(pose).transforms)
    points = [
        (centre[:, None] + (axes * scales) @ random.normal(size=(3, each))).T
        for centre, axes, scales in zip(
            placed.centres, placed.axes, registrar.primitives.scales, strict=True
        )
    ]
    points = np.concatenate(points)
    return Observation(points, np.ones(len(points)), np.full(len(points), VARIANCE))


@pytest.mark.parametrize("compiled", [True, False])
def test_covariance_is_that_of_the_poses_that_noise_leads_to(body, random, compiled):
    registrar, bones = method(compiled=compiled).bind(body), body.skeleton
    truth, steps, told = pose_of(body, 20.0), [], []
    for _ in range(120 if compiled else 4):
        data = drawn(registrar, truth, random)
        prior = Prior(truth, points=float(len(data.points)))
        found = registrar.register(data, [truth], prior=prior)
        steps.append(bones.difference(found.pose, truth))
        told.append(found.covariance)
    own = bones.independent_dofs
    expected = np.mean(told, axis=0)
    np.testing.assert_allclose(expected, told[0], rtol=0.5, atol=0.1 * np.abs(expected).max())
    # Normalised steps have unit variance; the mean of 120 x 10 squares is within 15 %.
    factor = np.linalg.cholesky(np.linalg.inv(expected[np.ix_(own, own)]))
    normalised = np.array(steps)[:, own] @ factor
    within = 0.15 if compiled else 0.8
    assert (normalised**2).mean() == pytest.approx(1.0, abs=within)
    markers = marker_covariances(body.markers.jacobian(body.place(truth)), expected)
    assert (np.linalg.eigvalsh(markers) > 0.0).all()


def test_covariance_does_not_depend_on_the_start(body, random):
    registrar = method().bind(body)
    truth = pose_of(body, 20.0)
    data = drawn(registrar, truth, random)
    step = 0.2 * random.normal(size=body.skeleton.dofs)
    step[:3] *= 0.1
    near, far = (
        registrar.register(data, [start], prior=Prior(truth, points=100.0))
        for start in (truth, body.skeleton.limits.hinged(body.skeleton.retract(truth, step)))
    )
    assert np.abs(body.skeleton.difference(near.pose, far.pose)).max() < 1e-4
    np.testing.assert_allclose(far.covariance, near.covariance, rtol=0.02, atol=1e-8)


@pytest.mark.parametrize("solver", ["lbfgs", "ipopt"])
@pytest.mark.parametrize("coordinates", ["tangent", "quaternion"])
def test_every_solver_and_all_coordinates_have_the_same_covariance(
    body, random, solver, coordinates
):
    truth = pose_of(body, 20.0)
    registrar = method().bind(body)
    data, prior = drawn(registrar, truth, random), Prior(truth, points=100.0)
    expected = registrar.register(data, [truth], prior=prior)
    settings = {"kind": solver, "max_iterations": 300, "value_tolerance": 1e-12}
    other = method(solver=settings, coordinates=coordinates).bind(body)
    found = other.register(data, [expected.pose], prior=prior)
    assert np.abs(body.skeleton.difference(found.pose, expected.pose)).max() < 1e-4
    largest = np.abs(expected.covariance).max()
    np.testing.assert_allclose(
        found.covariance, expected.covariance, rtol=0.02, atol=1e-4 * largest
    )


def test_coupled_hinge_moves_with_its_leader(body, random):
    registrar, bones = method().bind(body), body.skeleton
    truth = pose_of(body, 20.0)
    found = registrar.register(drawn(registrar, truth, random), [truth], prior=Prior(truth))
    assert found.covariance is None  # Nobody has told how many points are independent.
    covariance = found.curvature.covariance(50.0)
    (leader,), (follower,) = bones.dofs_of("finger"), bones.dofs_of("tip")
    np.testing.assert_allclose(covariance[follower], 0.5 * covariance[leader], rtol=1e-9)
    assert found.curvature.information(50.0).shape == (10, 10)


def test_limit_that_is_pressed_leaves_no_variance_and_others_as_they_are(body, random):
    registrar, bones = method().bind(body), body.skeleton
    (hinge,) = bones.dofs_of("finger")
    inside, beyond = pose_of(body, 55.0), pose_of(body, 55.0)
    step = np.zeros(bones.dofs)
    step[hinge] = np.radians(20.0)
    beyond = bones.retract(beyond, step)  # 75 degrees, of 60.
    free = registrar.register(drawn(registrar, inside, random), [inside], prior=Prior(inside))
    held = registrar.register(drawn(registrar, beyond, random), [inside], prior=Prior(inside))
    assert held.pose.hinges[0] == pytest.approx(np.radians(60.0), abs=1e-9)
    before, after = (one.curvature.covariance(300.0) for one in (free, held))
    assert after[hinge, hinge] < 0.05 * before[hinge, hinge]
    assert after[0, 0] == pytest.approx(before[0, 0], rel=0.5)


def test_joint_without_data_is_as_wide_as_its_limits_or_its_prior(body, random):
    registrar, bones = method().bind(body), body.skeleton
    truth = pose_of(body, 0.0)
    data = drawn(registrar, truth, random)
    placed = registrar.primitives.place(body.place(truth).transforms)
    hand = np.isin(registrar.primitives.segments, [body.skeleton.names.index("finger"),
                                                   body.skeleton.names.index("tip")])  # fmt: skip
    near = np.linalg.norm(data.points[:, None] - placed.centres[None], axis=2).argmin(axis=1)
    kept = ~hand[near]
    data = Observation(data.points[kept], data.weights[kept], data.variances[kept])
    (hinge,) = bones.dofs_of("finger")
    found = registrar.register(data, [truth], prior=Prior(truth))
    wide = found.curvature.covariance(100.0)[hinge, hinge]
    assert wide == pytest.approx(np.radians(120.0) ** 2 / 12.0, rel=0.02)
    assert wide == pytest.approx(spread_variances(bones.limits, free=True)[hinge, hinge], rel=0.02)
    information = np.zeros((bones.dofs, bones.dofs))
    information[hinge, hinge] = 1.0 / np.radians(3.0) ** 2
    informed = method(terms=["motion_prior"]).bind(body)
    found = informed.register(data, [truth], prior=Prior(truth, information, 100.0))
    assert found.covariance[hinge, hinge] == pytest.approx(np.radians(3.0) ** 2, rel=0.02)
    assert found.information[9, 9] == pytest.approx(0.0, abs=1.0)


def test_effective_points_are_all_if_independent_and_the_groups_if_not(random):
    points, residuals = random.uniform(size=(200, 3)), random.normal(size=(200, 3))
    counted = effective_points(points, residuals, np.ones(200), 0.1, 200)
    assert counted == pytest.approx(200.0, rel=0.15)
    # Groups far apart, each of whose points err alike.
    centres, errors = 10.0 * random.uniform(size=(40, 3)), random.normal(size=(40, 3))
    errors /= np.sqrt((errors**2).mean())
    points = (centres[:, None] + 0.01 * random.normal(size=(40, 5, 3))).reshape(-1, 3)
    counted = effective_points(points, np.repeat(errors, 5, axis=0), np.ones(200), 1.0, 200)
    assert counted == pytest.approx(40.0, rel=0.25)
    # Errors twice as large as the model expects tell a fourth.
    twice = effective_points(points, np.repeat(2.0 * errors, 5, axis=0), np.ones(200), 1.0, 200)
    assert twice == pytest.approx(counted / 4.0)
    assert np.isnan(effective_points(points, np.zeros((200, 3)), np.ones(200), 1.0, 200))


def test_inverse_is_the_inverse_or_not_a_number(random):
    root = random.normal(size=(12, 12)) * 10.0 ** random.uniform(-3.0, 3.0, size=12)
    matrix = root.T @ root
    np.testing.assert_allclose(inverted(matrix) @ matrix, np.eye(12), atol=1e-5)
    assert np.isnan(inverted(-matrix)).all()


def test_what_is_hidden_is_believed_less_and_held_as_before(body, random):
    registrar, bones = method().bind(body), body.skeleton
    truth = pose_of(body, 20.0)
    found = registrar.register(drawn(registrar, truth, random), [truth], prior=Prior(truth))
    seen = found.curvature
    np.testing.assert_allclose(seen.carried(50.0), seen.covariance(50.0))
    (hinge,) = bones.dofs_of("finger")
    shown = np.ones(10)
    shown[9] = 0.1  # The only independent hinge.
    hidden = replace(seen, shown=shown)
    np.testing.assert_allclose(hidden.carried(50.0), seen.carried(50.0))
    wider = hidden.covariance(50.0)
    assert wider[hinge, hinge] > 20.0 * seen.covariance(50.0)[hinge, hinge]
    assert wider[0, 0] == pytest.approx(seen.covariance(50.0)[0, 0], rel=0.2)
    assert wider[hinge, hinge] < bones.spread[hinge, hinge]
