"""The landmarks term: exact derivatives in both forms, and what landmarks are for."""

from dataclasses import replace

import numpy as np
import pytest

from regkit.geometry.camera import Camera
from regkit.geometry.rigid import rigid
from regkit.interfaces import CompiledEnergy, Prior, Scene, Template
from regkit.observation import Landmarks, Observation
from regkit.primitives.arrays import PrimitiveArrays
from regkit.registration import Plan, PlannedEnergy, TangentCoordinates
from regkit.system.errors import DataError
from regkit.testing.compiled_laws import nothing
from regkit_plugins.shapes.sog import SumOfGaussians
from regkit_plugins.terms.landmarks import LandmarksTerm

CAMERA = Camera(width=176, height=144, fx=230.0, fy=210.0, cx=87.5, cy=71.5)


def template_body(name):
    template = Template.parse(name, place="test", field="template")
    return template.body(template.candidate_sizes()[2])


def posed(body, random, depth, spread=0.3):
    bones = body.skeleton
    pose = bones.rest(rigid(np.eye(3), np.array([0.1, -0.05, depth])))
    pose = bones.retract(pose, spread * random.normal(size=bones.dofs))
    return bones.limits.projected(pose)


def landmarks_near(body, pose, random, *, flat, error=0.04):
    places = body.markers.place(body.place(pose).transforms)
    places = places + random.normal(scale=[error, 0.6 * error, 0.3 * error], size=places.shape)
    names, sure = body.markers.names, random.uniform(0.2, 1.0, len(places))
    if not flat:
        return Landmarks.in_space(names, places, sure)
    before = np.maximum(places, [-np.inf, -np.inf, 0.2])
    return Landmarks.in_picture(names, CAMERA.projected(before), sure)


def scene_of(body, pose, marks):
    points = body.markers.place(body.place(pose).transforms)
    count = len(points)
    data = Observation(
        points, np.ones(count), np.full(count, 1e-4), CAMERA, landmarks=marks
    )  # fmt: skip
    placed = SumOfGaussians().bind(body).place(body.place(pose).transforms)
    return Scene(body, data, Prior(pose), placed)


def compiled_energy(term, scene):
    primitives = scene.placed.primitives
    parts = (CompiledEnergy(nothing), term.compiled(scene.body, primitives))
    plan = Plan(scene.body, PrimitiveArrays.of(primitives), parts)
    bound = PlannedEnergy.of(plan, scene.observation, [scene.prior.pose], scene.prior)
    assert bound is not None
    return bound[0]


@pytest.mark.parametrize("flat", [False, True], ids=["space", "picture"])
@pytest.mark.parametrize("loss", ["squares", "huber", "tukey", "geman_mcclure"])
@pytest.mark.parametrize(("name", "depth"), [("human", 2.5), ("hand", 0.5), ("human", 0.3)])
def test_both_forms_have_the_derivative_of_their_energy(name, depth, loss, flat):
    # At 0.3 m some of a person's markers are behind the camera; the hand has coupled hinges.
    random = np.random.default_rng(5)
    body = template_body(name)
    pose = posed(body, random, depth)
    marks = landmarks_near(body, pose, random, flat=flat, error=0.03 * body.size)
    scene, term = scene_of(body, pose, marks), LandmarksTerm(weight=0.3, loss=loss)
    energy, fast = term.bind(scene), compiled_energy(term, scene)
    chart = TangentCoordinates(body.skeleton, pose)
    x = 0.02 * random.normal(size=len(chart.origin()))
    at = chart.pose(x)
    response = energy(at)
    slope = chart.jacobian(x).T @ response.force
    numeric = np.array([
        energy(chart.pose(x + 1e-6 * unit)).energy - energy(chart.pose(x - 1e-6 * unit)).energy
        for unit in np.eye(len(x))
    ]) / 2e-6  # fmt: skip
    np.testing.assert_allclose(slope, numeric, rtol=1e-4, atol=1e-5 * np.abs(numeric).max())
    value, force, matrix = fast.derivatives(at, 2)
    assert value == pytest.approx(response.energy, rel=1e-5)
    largest = np.abs(response.stiffness).max()
    np.testing.assert_allclose(force, response.force, atol=1e-5 * np.abs(response.force).max())
    np.testing.assert_allclose(matrix, response.stiffness, atol=1e-5 * largest)


def test_markers_behind_the_camera_are_pulled_before_it(linkage):
    pose = linkage.skeleton.rest(rigid(np.eye(3), np.array([0.3, 0.0, -0.5])))
    names = linkage.markers.names
    marks = Landmarks.in_picture(names, np.full((len(names), 2), 80.0))
    energy = LandmarksTerm(loss="squares").bind(scene_of(linkage, pose, marks))
    before = replace(pose, root=rigid(np.eye(3), np.array([0.3, 0.0, 2.0])))
    assert energy(pose).energy > energy(before).energy
    assert np.isfinite(energy(pose).force).all()


def test_landmark_far_off_does_not_pull(linkage):
    random = np.random.default_rng(2)
    pose = posed(linkage, random, 2.0)
    places = linkage.markers.place(linkage.place(pose).transforms)
    places[0] += [1.5, 0.0, 0.0]
    marks = Landmarks.in_space(linkage.markers.names, places)
    force = LandmarksTerm().bind(scene_of(linkage, pose, marks))(pose).force
    near = replace(marks, positions=np.where(np.arange(len(places))[:, None] == 0, 0.03, 0) + places
                   - [[1.5, 0, 0]] * (np.arange(len(places))[:, None] == 0))  # fmt: skip
    usual = LandmarksTerm().bind(scene_of(linkage, pose, near))(pose).force
    assert np.abs(force).max() < 0.01 * np.abs(usual).max()


def test_unmeasured_and_unknown_landmarks_have_no_effect(linkage):
    pose = posed(linkage, np.random.default_rng(3), 2.0)
    names = (*linkage.markers.names, "nose")
    places = np.full((len(names), 3), np.nan)
    places[-1] = 0.0
    for marks in (None, Landmarks.in_space(names, places)):
        scene = scene_of(linkage, pose, marks)
        response = LandmarksTerm().bind(scene)(pose)
        assert response.energy == 0.0
        assert not response.force.any()
        assert compiled_energy(LandmarksTerm(), scene).total(pose) == 0.0


def test_position_in_space_counts_before_the_pixel(linkage):
    pose = posed(linkage, np.random.default_rng(4), 2.0)
    places = linkage.markers.place(linkage.place(pose).transforms)
    marks = Landmarks(
        linkage.markers.names, places, np.zeros((len(places), 2)), np.ones(len(places))
    )
    assert LandmarksTerm().bind(scene_of(linkage, pose, marks))(pose).energy == pytest.approx(0.0)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"confidences": np.array([1.0, 1.5])}, "'b' is 1.5"),
        ({"confidences": np.array([1.0, np.nan])}, "'b' is nan"),
        ({"names": ("a", "a")}, "'a'"),
        ({"pixels": np.zeros((3, 2))}, "pixels"),
    ],
)
def test_damaged_landmarks_are_refused(change, said):
    sound = Landmarks.in_space(("a", "b"), np.zeros((2, 3)))
    with pytest.raises(DataError, match=said):
        replace(sound, **change)
