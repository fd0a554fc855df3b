"""Poses by landmarks: fits from far off, and recovery of a body or limb that they contradict."""

from dataclasses import replace

import numpy as np
import pytest

from regkit.geometry.camera import Camera
from regkit.geometry.rigid import rigid
from regkit.interfaces import Method, RegistrationResult, Template
from regkit.observation import Landmarks, Observation
from regkit.search.landmark_fit import LandmarkFit
from regkit.search.limb_recovery import LimbRecovery
from regkit.search.limbs import limbs_of
from regkit.skeleton import Pose

CAMERA = Camera(width=176, height=144, fx=230.0, fy=230.0, cx=87.5, cy=71.5)


@pytest.fixture(scope="module")
def person():
    return Template.parse("human", place="test", field="template").body(1.7)


@pytest.fixture(scope="module")
def truth(person):
    """A person who faces the camera, with unlike limbs."""
    bones = person.skeleton
    root = rigid(np.diag([1.0, -1.0, -1.0]), np.array([0.0, 0.0, 2.8]))
    step = 0.3 * np.random.default_rng(1).normal(size=bones.dofs)
    step[:6] = 0.0
    return bones.limits.projected(bones.retract(bones.rest(root), step))


def seen(body, pose, random, *, flat=False, outliers=0.0):
    """Points of the side that the camera sees, and landmarks."""
    surface = body.surface.place(body.place(pose).transforms)
    points = surface[random.choice(len(surface), 500, replace=False)]
    places = body.markers.place(body.place(pose).transforms)
    wrong = random.random(len(places)) < outliers
    if flat:
        pixels = CAMERA.projected(places) + random.normal(scale=1.0, size=(len(places), 2))
        pixels[wrong] += random.uniform(-60, 60, (int(wrong.sum()), 2))
        marks = Landmarks.in_picture(body.markers.names, pixels)
    else:
        places = places + random.normal(scale=0.02, size=places.shape)
        places[wrong] += random.uniform(-0.8, 0.8, (int(wrong.sum()), 3))
        marks = Landmarks.in_space(body.markers.names, places)
    ones = np.ones(len(points))
    return Observation(points, ones, 0.015**2 * ones, CAMERA, landmarks=marks)


def turned(pose):
    return Pose(pose.root @ np.diag([-1.0, 1.0, -1.0, 1.0]), pose.balls, pose.hinges)


def error(body, pose, truth):
    places = [body.markers.place(body.place(one).transforms) for one in (pose, truth)]
    return float(np.linalg.norm(places[0] - places[1], axis=1).mean())


@pytest.mark.parametrize("flat", [False, True], ids=["space", "picture"])
def test_turned_body_with_other_joints_is_found_among_outliers(person, truth, flat):
    random = np.random.default_rng(3)
    fit = LandmarkFit.of(person, seen(person, truth, random, flat=flat, outliers=0.2))
    rest = person.skeleton.rest(turned(truth).root)
    found = fit.turned(rest)
    costs = list(map(fit.cost, found))
    assert costs == sorted(costs)
    # A picture does not tell front from back, so that the best may face the other way.
    rivals = found if flat else found[:1]
    assert min(error(person, one, truth) for one in rivals) < (0.12 if flat else 0.04)
    assert max(person.skeleton.limits.violation(one).max() for one in found) < 1e-6


def test_frame_without_landmarks_of_the_body_has_no_fit(person, truth):
    data = seen(person, truth, np.random.default_rng(0))
    assert LandmarkFit.of(person, replace(data, landmarks=None)) is None
    strange = data.landmarks.renamed(lambda name: f"some_{name}")
    assert LandmarkFit.of(person, replace(data, landmarks=strange)) is None


def test_landmarks_turn_a_body_and_move_its_arm_and_change_nothing_that_is_right(person, truth):
    random = np.random.default_rng(5)
    data = seen(person, truth, random, outliers=0.08)
    method = Method.parse({"preset": "best", "terms": ["landmarks"]}, place="test", field="method")
    recovery = LimbRecovery.of(method.bind(person))
    registrar = recovery.registrar
    right = registrar.register(data, [truth])
    assert recovery.corrected(data, right) is right
    arm = next(limb for limb in limbs_of(person) if limb.name == "left_upper_arm")
    balls, hinges = person.skeleton.limits.sampled(random, 4)
    wrong = arm.rotated(right.pose, balls[2], hinges[2])
    assert error(person, wrong, truth) > 0.05
    for start in (turned(truth), wrong):
        found = recovery.corrected(data, RegistrationResult.given(start))
        assert error(person, found.pose, truth) < 0.04
