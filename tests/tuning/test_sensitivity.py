"""Sensitivity: a primitive that moves takes the end of a registration along, as it is computed."""

import numpy as np
import pytest

from regkit.api.pipeline import preprocessor_for
from regkit.interfaces import Method, Prior
from regkit.skeleton import Pose
from regkit.tuning import Sampler
from regkit.tuning.sensitivity import sensitivity
from regkit.tuning.sets import SampleSets
from regkit.tuning.tunable import Tunable

EXACT = Method.parse(
    {
        "preset": "best",
        "compiled": False,
        "solver": {"kind": "gauss_newton", "max_iterations": 200, "value_tolerance": 1e-12},
    },
    place="tests",
    field="method",
)
"""Registers to the last bit, and has gradients in double precision."""

BY = 0.002
"""Variation of a parameter in differences."""


@pytest.fixture(scope="module")
def sets(kite_template):
    return SampleSets(kite_template, preprocessor_for)


@pytest.fixture(scope="module")
def tunable(sets):
    listed = sets.body.shapes["gsog"]
    return Tunable(EXACT, EXACT.tracker, sets.body, "gsog", listed, listed)


@pytest.fixture(scope="module")
def sample(sets):
    return Sampler(sets.body, sets.preprocessor, frames=1, seed=5).sample(1)


def placed(body, pose):
    return body.markers.place(body.place(pose).transforms)


def ended(registrar, observation, pose):
    """Where a registration ends that starts there: all is bound at a start, so it is repeated."""
    for _ in range(100):
        found = registrar.register(observation, [pose]).pose
        moved = np.abs(placed(registrar.body, found) - placed(registrar.body, pose)).max()
        pose = found
        if moved < 1e-10:
            return pose
    raise AssertionError("it does not come to rest")


def check(tunable, observation, pose, monkeypatch):
    """The computed displacements are those found by registering anew."""
    # Directions that the data hardly hold move less than the registration does; here all count.
    monkeypatch.setattr("regkit.tuning.sensitivity.FLOOR", 0.0)
    start, body = tunable.start(), tunable.body
    markers = np.arange(len(body.markers.names))
    varied = tunable.varied(start, BY)
    rows = sensitivity(tunable.registrar(start), varied, BY, observation, pose, markers)
    for index in range(0, len(start), 4):
        ahead = placed(body, ended(varied[index], observation, pose))
        expected = (ahead - placed(body, pose)).ravel() / BY
        assert np.abs(expected).max() > 1e-5
        np.testing.assert_allclose(
            rows[:, index], expected, atol=0.01 * np.abs(expected).max(), err_msg=str(index)
        )


def test_markers_move_as_registrations_end(tunable, sample, monkeypatch):
    pose = ended(tunable.registrar(tunable.start()), sample.observations[0], sample.starts[0])
    assert not tunable.body.skeleton.limits.violation(pose).any()
    check(tunable, sample.observations[0], pose, monkeypatch)


def test_joint_limit_that_holds_the_pose_keeps_holding_it(tunable, sets, monkeypatch):
    sampler = Sampler(sets.body, sets.preprocessor, frames=1, seed=5)
    description = sets.template.description()
    sample = sampler.sample(1)
    free = ended(tunable.registrar(tunable.start()), sample.observations[0], sample.starts[0])
    # The same body, whose left arm may not rise as far as the data pull it.
    arm = description.segments["left_arm"]
    least = float(np.degrees(free.hinges[0])) + 4.0
    joint = arm.joint.model_copy(update={"limits_deg": (least, 90.0)})
    segments = {**description.segments, "left_arm": arm.model_copy(update={"joint": joint})}
    body = description.model_copy(update={"segments": segments}).body("held", sets.body.size)
    listed = body.shapes["gsog"]
    held = Tunable(EXACT, EXACT.tracker, body, "gsog", listed, listed)
    start = Pose(free.root, free.balls, np.array([np.radians(least), free.hinges[1]]))
    pose = ended(held.registrar(held.start()), sample.observations[0], start)
    assert np.degrees(pose.hinges[0]) == pytest.approx(least, abs=1e-6)
    check(held, sample.observations[0], pose, monkeypatch)


def test_gradient_vanishes_where_a_registration_ends(tunable, sample):
    registrar, observation = tunable.registrar(tunable.start()), sample.observations[0]
    pose = ended(registrar, observation, sample.starts[0])
    there = registrar.gradient(observation, sample.starts[0])
    assert np.abs(registrar.gradient(observation, pose)).max() < 1e-6 * np.abs(there).max()


@pytest.mark.parametrize("compiled", [True, False])
def test_gradient_is_that_of_the_energy_bound_at_the_pose(sets, sample, compiled):
    method = Method.parse({"preset": "best", "compiled": compiled}, place="tests", field="method")
    registrar, observation = method.bind(sets.body), sample.observations[0]
    pose = sample.starts[0]
    # What is bound at a pose stays while a solver moves: its first evaluation is the energy there.
    energy, _ = registrar._best(observation, [pose], Prior(pose), 0.0, registrar.plan)
    skeleton, step = sets.body.skeleton, 1e-3
    expected = [
        (energy.total(skeleton.retract(pose, ahead)) - energy.total(skeleton.retract(pose, -ahead)))
        / (2.0 * step)
        for ahead in step * np.eye(skeleton.dofs)
    ]
    found = registrar.gradient(observation, pose)
    np.testing.assert_allclose(found, expected, atol=5e-3 * np.abs(found).max())
