"""Laws of the energy of several cameras."""

from dataclasses import replace

import numpy as np
import pytest
from around import facing, frame_around

from regkit.geometry.rigid import exp
from regkit.interfaces import Method, Preprocessor, Prior
from regkit.observation import Observation, View
from regkit.registration import PlannedEnergy, ViewEnergy
from regkit_plugins.templates.hand import Hand
from regkit_plugins.templates.human import Human

METHODS = {
    "likelihood": {
        "shape": {"kind": "gsog", "surface": "visible"},
        "kernel": "likelihood",
        "terms": ["visibility", "intersection", "continuity", "free_space", "limits"],
    },
    "correlation": {
        "shape": "gsog",
        "kernel": {"kind": "correlation", "covariance": "exact"},
        "terms": ["intersection", {"kind": "continuity", "weight": 3.0}, "clamp"],
    },
    "spheres": {
        "shape": "sphere",
        "kernel": "sphere_distance",
        "terms": ["visibility", "free_space", "continuity"],
    },
}


def method_of(name, *, compiled, solver="gauss_newton", without=()):
    parts = METHODS[name]
    terms = [one for one in parts["terms"] if one not in without]
    data = {"kind": "direct", "solver": solver, "compiled": compiled, **parts, "terms": terms}
    return Method.parse(data, place="test", field="method")


def observed(frame, size):
    data = {"kind": "points", "voxel": 0.05 * size, "sigma": 0.02 * size}
    return Preprocessor.parse(data, place="test", field="preprocessor").observation(frame)


@pytest.fixture(scope="module")
def body():
    return Human(height=1.7).body(1.7)


@pytest.fixture(scope="module")
def data(body):
    """What three cameras see of a body, from the front, from the side and from behind."""
    return observed(frame_around(body, facing(body, turn=0.3), [0.0, 1.2, 2.8]), body.size)


def nearby(body, pose, seed=3):
    step = 0.08 * np.random.default_rng(seed).normal(size=body.skeleton.dofs)
    return body.skeleton.limits.projected(body.skeleton.retract(pose, step))


@pytest.mark.parametrize("compiled", [True, False])
@pytest.mark.parametrize("name", METHODS)
def test_force_of_views_equals_differences(name, compiled, body, data):
    bones = body.skeleton
    pose = nearby(body, facing(body, turn=0.3))
    # Blocks of a picture have edges, at which the energy of free space has no derivative.
    bound = method_of(name, compiled=compiled, without=["free_space"]).bind(body)
    energy, _ = bound._best(data, [pose], Prior(facing(body, turn=0.3)), 0.0, bound.plan)
    assert (bound.plan is not None) == compiled
    at = nearby(body, pose, seed=4)
    force = energy.force(at)
    for dof in [0, 1, 2, 3, 5, *np.random.default_rng(0).choice(np.arange(6, bones.dofs), 6)]:
        step = np.zeros(bones.dofs)
        # Single precision of the compiled kernels of Gaussians needs a large step.
        step[dof] = 2e-3 if compiled and name != "spheres" else 1e-5
        rise = energy.total(bones.retract(at, step)) - energy.total(bones.retract(at, -step))
        expected = rise / (2.0 * step[dof])
        tolerance = 5e-3 if compiled else 1e-4
        assert force[dof] == pytest.approx(expected, abs=tolerance * np.abs(force).max())


@pytest.mark.parametrize("name", METHODS)
def test_compiled_views_equal_readable_ones(name, body, data):
    pose = nearby(body, facing(body, turn=0.3))
    compiled, readable = (
        method_of(name, compiled=mode).bind(body)._best(data, [pose], Prior(pose), 0.0, plan)[0]
        for mode in (True, False)
        for plan in [method_of(name, compiled=mode).bind(body).plan]
    )
    at = nearby(body, pose, seed=4)
    for one, other in zip(compiled.derivatives(at, 2), readable.derivatives(at, 2), strict=True):
        np.testing.assert_allclose(one, other, rtol=0, atol=2e-3 * np.abs(other).max())


@pytest.mark.parametrize("compiled", [True, False])
@pytest.mark.parametrize("name", METHODS)
def test_one_view_at_the_origin_is_the_frame_itself(name, compiled, body):
    truth = facing(body, turn=0.3)
    alone = observed(frame_around(body, truth, [0.0]), body.size)
    assert not alone.views
    assert Observation.of_views([View("camera", np.eye(4), alone)]) is alone
    viewed = replace(alone, camera=None, depth=None, views=(View("camera", np.eye(4), alone),))
    bound = method_of(name, compiled=compiled).bind(body)
    start = nearby(body, truth)
    before, inside = bound.evaluate(alone, start), bound.evaluate(viewed, start)
    assert inside.energy == pytest.approx(before.energy, rel=1e-14)
    np.testing.assert_array_equal(before.inlier_probability, inside.inlier_probability)
    force, same = bound.gradient(alone, start), bound.gradient(viewed, start)
    np.testing.assert_allclose(same, force, rtol=1e-12, atol=1e-12 * np.abs(force).max())


@pytest.mark.parametrize("compiled", [True, False])
@pytest.mark.parametrize("name", METHODS)
def test_common_motion_of_cameras_and_body_leaves_energy_alone(name, compiled, body, data):
    motion = exp(np.array([0.4, -0.7, 1.1, 0.8, -0.5, 0.3]))
    moved = Observation.of_views([view.moved(motion) for view in data.views])
    pose = nearby(body, facing(body, turn=0.3))
    there = pose.moved(motion)
    bound = method_of(name, compiled=compiled).bind(body)
    tolerance = 1e-4 if compiled else 1e-9
    before, after = bound.evaluate(data, pose).energy, bound.evaluate(moved, there).energy
    assert after == pytest.approx(before, rel=tolerance)
    force, turned = bound.gradient(data, pose), bound.gradient(moved, there)
    turned[:3] = turned[:3] @ motion[:3, :3]
    np.testing.assert_allclose(turned, force, rtol=0, atol=20 * tolerance * np.abs(force).max())


def test_energy_of_views_is_the_mean_over_their_points(body, data):
    pose = nearby(body, facing(body, turn=0.3))
    bound = method_of("likelihood", compiled=True, without=METHODS["likelihood"]["terms"]).bind(
        body
    )
    counts = np.array([len(view.data.points) for view in data.views])
    each = [bound.evaluate(view.data, pose.moved(view.to_camera)) for view in data.views]
    mean = float(counts @ [one.energy for one in each]) / counts.sum()
    assert bound.evaluate(data, pose).energy == pytest.approx(mean, rel=1e-12)


@pytest.mark.parametrize("solver", ["gauss_newton", "lbfgs", "ipopt"])
def test_solvers_register_views(solver, body, data):
    truth = facing(body, turn=0.3)
    start = nearby(body, truth)
    bound = method_of("likelihood", compiled=True, solver=solver).bind(body)
    found = bound.register(data, [start])
    off = [
        np.linalg.norm(
            body.markers.place(body.place(one).transforms)
            - body.markers.place(body.place(truth).transforms),
            axis=1,
        ).mean()
        for one in (start, found.pose)
    ]
    assert off[1] < 0.6 * off[0]
    assert found.energy <= bound.evaluate(data, start).energy


def test_best_candidate_of_views_is_the_start(body, data):
    truth = facing(body, turn=0.3)
    far = nearby(body, facing(body, turn=1.4))
    bound = method_of("likelihood", compiled=True).bind(body)
    assert bound.register(data, [far, truth]).energy == pytest.approx(
        bound.register(data, [truth], prior=Prior(far)).energy
    )


def test_hand_with_a_view_of_other_variances_is_registered_too():
    hand = Hand(length=0.19).body(0.19)
    truth = facing(hand, distance=3.0)
    data = observed(frame_around(hand, truth, [0.0, 0.9]), hand.size)
    first, second = data.views
    uneven = replace(
        second,
        data=replace(
            second.data,
            variances=second.data.variances * np.linspace(1, 2, len(second.data.points)),
        ),
    )
    mixed = Observation.of_views([first, uneven])
    bound = method_of("likelihood", compiled=True).bind(hand)
    energy, _ = bound._best(mixed, [truth], Prior(truth), 0.0, bound.plan)
    kinds = [isinstance(one.energy, PlannedEnergy) for one in energy.views]
    assert all(isinstance(one, ViewEnergy) for one in energy.views)
    assert kinds == [True, False]
    assert np.isfinite(bound.register(mixed, [truth]).energy)
