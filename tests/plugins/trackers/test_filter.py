"""The filter holds what it saw, grows unsure of what it does not see, and follows what moves."""

import numpy as np
import pytest

from regkit.interfaces import Method, Past
from regkit.observation import Observation
from regkit.system.errors import ConfigError
from regkit.testing.samples import posed
from regkit_plugins.trackers.filter import Filter
from regkit_plugins.trackers.filter.compiled import predicted_information

METHOD = {
    "kind": "direct",
    "shape": {"kind": "gsog", "surface": "volume"},
    "kernel": "likelihood",
    "solver": "gauss_newton",
    "terms": ["motion_prior"],
}


def without_leg(linkage, pose, random):
    """Points on the surface of all capsules but the leg's."""
    axes = linkage.capsules.axis_points(0.02)
    kept = axes.segments != linkage.skeleton.names.index("leg")
    centres = axes.place(linkage.place(pose).transforms)[kept]
    directions = random.normal(size=(len(centres), 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    points = centres + axes.radii[kept, None] * directions
    return Observation(points, np.ones(len(points)), np.full(len(points), 1e-4))


def test_filter_is_unsure_of_what_is_hidden_and_sure_of_what_it_sees(linkage, random):
    bones = linkage.skeleton
    registrar = Method.parse(METHOD, place="test", field="method").bind(linkage)
    tracker = Filter(joint_deg=10.0, recovery=None).bind(registrar)
    pose = bones.limits.projected(posed(linkage, random))
    leg, arm, elbow = (bones.dofs_of(name) for name in ("leg", "arm", "forearm"))
    past, widths = Past.start(pose), []
    for _ in range(12):
        found = tracker.step(without_leg(linkage, pose, random), past)
        widths.append([np.trace(found.covariance[np.ix_(own, own)]) for own in (leg, arm)])
        past = past.followed_by(found)
        assert 1.0 < found.effective_points <= 1000.0
    hidden, seen = np.array(widths).T
    assert (hidden > 5.0 * seen).all()
    assert seen.max() < 0.1 * np.trace(bones.spread[np.ix_(arm, arm)])
    assert np.abs(bones.difference(pose, past.last.pose)[elbow]).max() < np.radians(10.0)


def test_prediction_widens_by_the_noise_and_ends_at_the_spread(random):
    root = random.normal(size=(8, 8))
    covariance, noise, spread = 0.01 * root @ root.T, np.full(8, 0.02), np.full(8, 2.0)
    leaders = np.array([0, 0])  # The second hinge follows the first one.
    for _ in range(2000):
        information = predicted_information(covariance, noise, np.zeros(8), spread, leaders, 6)
        assert not information[7].any()
        wider = np.linalg.inv(information[:7, :7])
        share = 1.0 - 0.02 / 2.0
        np.testing.assert_allclose(
            np.diag(wider), share * np.diag(covariance)[:7] + 0.02, rtol=1e-9
        )
        covariance = np.zeros((8, 8))
        covariance[:7, :7] = wider
    np.testing.assert_allclose(np.diag(wider), 2.0, rtol=1e-3)


def test_motion_makes_the_next_step_uncertain_about_every_axis_of_the_joint(random):
    motion = np.zeros(7)
    motion[3] = 0.3
    noise, spread = np.full(7, 0.01), np.full(7, 10.0)
    information = predicted_information(np.zeros((7, 7)), noise, motion, spread, np.array([0]), 6)
    np.testing.assert_allclose(1.0 / np.diag(information)[3:], [0.1, 0.1, 0.1, 0.01])


def test_noise_of_an_unknown_joint_is_refused(linkage):
    with pytest.raises(ConfigError, match=r"joints_deg\.forarm: .*did you mean 'forearm'"):
        Filter(joints_deg={"forarm": 5.0}).noise(linkage.skeleton)


def on_surface(linkage, pose, random):
    """Points on the surface of all capsules."""
    axes = linkage.capsules.axis_points(0.02)
    directions = random.normal(size=(len(axes.segments), 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    points = axes.place(linkage.place(pose).transforms) + axes.radii[:, None] * directions
    return Observation(points, np.ones(len(points)), np.full(len(points), 1e-4))


def test_a_sudden_motion_is_followed_in_its_frame_and_a_usual_one_is_not_affected(linkage, random):
    bones = linkage.skeleton
    registrar = Method.parse(METHOD, place="test", field="method").bind(linkage)
    arm, start = bones.dofs_of("arm"), bones.limits.projected(bones.rest())
    turn = np.zeros(bones.dofs)
    turn[arm] = [0.0, 0.0, 0.6]
    sudden = bones.limits.projected(bones.retract(start, turn))
    errors = {}
    for unforeseen in (0.0, 1.0):
        settings = Filter(joint_deg=0.5, unforeseen=unforeseen, recovery=None)
        tracker, past = settings.bind(registrar), Past.start(start)
        seeded = np.random.default_rng(3)
        for _ in range(4):
            found = tracker.step(on_surface(linkage, start, seeded), past)
            past = past.followed_by(found)
        calm = np.abs(bones.difference(start, found.pose)).max()
        found = tracker.step(on_surface(linkage, sudden, seeded), past)
        moved = np.abs(bones.difference(sudden, found.pose)[arm]).max()
        errors[unforeseen] = (calm, moved)
    assert errors[1.0][0] == pytest.approx(errors[0.0][0], rel=0.2)
    assert errors[1.0][1] < 0.5 * errors[0.0][1]
