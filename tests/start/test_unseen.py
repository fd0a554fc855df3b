"""Limbs that no camera shows rest; what the picture tells of stays."""

from __future__ import annotations

import numpy as np
import pytest
from lamp import seen

from regkit.geometry.rigid import rigid
from regkit.observation import Observation
from regkit.skeleton import Pose, PoseDescription
from regkit.start import rested
from regkit_plugins.templates.human import Human

BODY = Human(height=1.7).body(1.7)
FOLDED = {"left_thigh": [-90, 0, 0], "left_shin": 100, "right_thigh": [-60, 0, 30]}


def posed(joints, down: float = 0.1) -> Pose:
    """The body 3 m before the camera, which its legs may be below."""
    pose = BODY.skeleton.pose(PoseDescription(joints=joints))
    return Pose(
        rigid(np.diag([1.0, -1.0, -1.0]), np.array([0.0, down, 3.0])), pose.balls, pose.hinges
    )


def off(one: Pose, other: Pose) -> np.ndarray:
    """Returns the distance of each marker [m]."""
    first, second = (BODY.markers.place(BODY.place(pose).transforms) for pose in (one, other))
    return np.linalg.norm(first - second, axis=1)


def in_sight(observation: Observation, pose: Pose) -> np.ndarray:
    """Returns which markers are inside the picture."""
    rows = observation.camera.projected(BODY.markers.place(BODY.place(pose).transforms))[:, 1]
    return (rows < observation.camera.height - 5) & ~of_legs()


def of_legs() -> np.ndarray:
    names = BODY.markers.names
    return np.array([any(part in name for part in ("knee", "ankle", "foot")) for name in names])


@pytest.mark.parametrize("joints", [{}, {"left_upper_arm": [0, 0, 60], "left_forearm": 40}])
def test_legs_below_the_picture_hang_and_the_rest_stays(joints):
    truth = posed(joints, down=1.3)
    observation = seen(BODY, truth, image=True)
    guess = posed({**joints, **FOLDED}, down=1.3)
    found = rested(BODY, guess, observation)
    assert off(guess, truth)[of_legs()].max() > 0.5
    assert off(found, truth)[of_legs()].max() < 0.35
    np.testing.assert_allclose(off(found, guess)[in_sight(observation, guess)], 0.0, atol=1e-9)
    assert BODY.skeleton.limits.violation(found).max() < 1e-9


def test_limbs_with_data_stay():
    pose = posed(FOLDED)
    found = rested(BODY, pose, seen(BODY, pose, image=True))
    np.testing.assert_array_equal(off(found, pose), 0.0)


def test_a_limb_that_the_camera_would_show_at_rest_keeps_its_pose():
    """Nothing is where the legs would hang: they must be folded somewhere."""
    folded = posed({"left_thigh": [-100, 0, 0], "left_shin": 140})
    observation = seen(BODY, folded, image=True)
    shin = BODY.capsules.segments == BODY.skeleton.names.index("left_shin")
    placed = BODY.capsules.place(BODY.place(folded).transforms).selected(shin)
    bare = observation.only(placed.surface_distance(observation.points) > 0.05)
    found = rested(BODY, folded, bare)
    np.testing.assert_array_equal(off(found, folded), 0.0)


def test_clouds_without_a_picture_tell_nothing_of_what_is_unseen():
    pose = posed(FOLDED)
    found = rested(BODY, pose, seen(BODY, posed({}, down=1.3)))
    assert found is pose
