"""Two desk lamps that are free in one scene, seen by a depth camera."""

from collections.abc import Sequence

import numpy as np
import yaml
from scipy.spatial.transform import Rotation

from regkit.body import Body, BodyDescription
from regkit.body.composing import beside
from regkit.body.members import Member
from regkit.geometry.rotation import vector_to_matrix
from regkit.observation import Observation
from regkit.skeleton import Pose
from regkit.skeleton.pose import PoseDescription, RootDescription
from regkit.system.arrays import Array
from tests.support.lamp import LAMP, seen

PLACES = ((-0.35, 0.3, 2.4, 0.3), (0.3, 0.35, 2.7, -0.4))
"""Where the lamps stand [m], and their turns about the upright [rad]."""


def lamp() -> BodyDescription:
    """One lamp alone."""
    return BodyDescription.model_validate(yaml.safe_load(LAMP))


def described() -> BodyDescription:
    """A lamp ``near`` and a lamp ``far``."""
    return beside([Member(name, lamp(), f"{name}_") for name in ("near", "far")], 0)


def lamps_at(body: Body, places: Sequence[tuple[float, float, float, float]]) -> Pose:
    """The lamps upright at places, each a position [m] and a turn [rad], with bent heads."""
    joints: dict[str, RootDescription | float] = {}
    for name, (x, y, z, turn) in zip(("near", "far"), places, strict=True):
        rotation = np.diag([1.0, -1.0, -1.0]) @ vector_to_matrix(np.array([0.0, turn, 0.0]))
        joints[f"{name}_foot"] = RootDescription(
            position=(x, y, z), rotation_deg=degrees_of(rotation)
        )
        joints[f"{name}_head"] = -60.0
    return body.skeleton.pose(PoseDescription(joints=joints))


def observed(body: Body, pose: Pose) -> Observation:
    """What a depth camera sees of both."""
    return seen(body, pose, image=True)


def degrees_of(rotation: Array) -> tuple[float, float, float]:
    """The rotation vector of a matrix [deg]."""
    x, y, z = np.degrees(Rotation.from_matrix(rotation).as_rotvec()).tolist()
    return x, y, z
