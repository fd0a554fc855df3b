"""Templates whose root is fixed in the world."""

from __future__ import annotations

import numpy as np

from regkit.body import BodyDescription
from regkit.geometry.rotation import from_matrix, to_vector
from regkit.skeleton.joints import FixedJoint
from regkit.system.arrays import Array


def at_base(description: BodyDescription, T_world_base: Array, source: str) -> BodyDescription:
    """Returns a template with its root fixed at a pose in the world.

    Args:
        description: The template, at the size of the robot.
        T_world_base: The pose of its root, (4, 4) [m].
        source: Where the pose comes from.
    """
    turn = np.degrees(to_vector(from_matrix(T_world_base[:3, :3])))
    x, y, z = T_world_base[:3, 3].tolist()
    place = {"offset": (x, y, z), "rotation_deg": tuple(turn.tolist()), "joint": FixedJoint()}
    segments = {
        name: one if one.parent is not None else one.model_copy(update=place)
        for name, one in description.segments.items()
    }
    update = {"segments": segments, "sources": (*description.sources, source)}
    return description.model_copy(update=update)
