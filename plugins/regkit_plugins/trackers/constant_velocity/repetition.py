"""The pose that follows if the last motion repeats."""

from __future__ import annotations

from regkit.skeleton import Pose, Skeleton
from regkit_plugins.trackers.constant_velocity.compiled import repeated_motion


def repeated(skeleton: Skeleton, before: Pose, last: Pose) -> Pose:
    """Returns the pose after repeating the last step, projected onto the limits.

    Args:
        skeleton: The skeleton.
        before: The pose before the last step.
        last: The pose after it.
    """
    root, balls = repeated_motion(before.root, before.balls, last.root, last.balls)
    hinges = 2.0 * last.hinges - before.hinges
    return skeleton.limits.projected(Pose(root if skeleton.free else last.root, balls, hinges))
