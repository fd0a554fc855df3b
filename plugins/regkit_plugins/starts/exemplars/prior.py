"""What decides where the data do not: likely stances, and the front of an upright body."""

from __future__ import annotations

import numpy as np

from regkit.body import Body
from regkit.skeleton import Pose

AWAY = 0.15
"""Cost of an upright body that turns its back on the camera; a generic body looks nearly alike from
both sides. Facing exchanged on synthetic data costs at least 0.2."""

UNUSUAL = 0.2
"""Cost of a mean squared difference of the joints to the nearest stance [1/rad^2]."""


def prior_cost(body: Body, pose: Pose, *, one_sided: bool) -> float:
    """Returns the cost of a pose without regard to the data, dimensionless.

    ``AWAY`` and ``UNUSUAL`` were chosen on 70 frames of people before a depth camera (UTD-MHAD) and
    150 synthetic ones of the development set of ``benchmarks/starts.py``.

    Args:
        body: The body.
        pose: Its pose in the camera's frame.
        one_sided: Whether a camera sees the body.
    """
    bones = body.skeleton
    joints = slice(bones.ball_dofs.start, bones.dofs)
    steps = [
        bones.difference(Pose(pose.root, stance.pose.balls, stance.pose.hinges), pose)[joints]
        for stance in body.stances
    ]
    cost = UNUSUAL * min((float((step**2).mean()) for step in steps if len(step)), default=0.0)
    if body.upright and one_sided:
        place = pose.root[:3, 3]
        turned = float(pose.root[:3, 2] @ place / np.linalg.norm(place))
        cost += AWAY * 0.5 * (1.0 + turned)
    return cost
