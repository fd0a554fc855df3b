"""Limbs that no camera shows: where nothing tells their pose, they rest as in a stance."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from regkit.body import Body
from regkit.observation import Observation
from regkit.search.limbs import limbs_of
from regkit.skeleton import Pose
from regkit.system.arrays import Array, Indices

SPACING = 0.05
"""Distance of the points that stand for a limb, as a fraction of the body's size."""

NEAR = 0.5
"""Data lie on a limb within this distance of its surface, in radii of a typical limb."""

FEW = 0.1
"""A smaller fraction of a segment's points counts as none."""


def rested(body: Body, pose: Pose, observation: Observation) -> Pose:
    """Returns the pose with the limbs that no camera shows as in a stance.

    What is beyond the picture, or behind something that was removed such as a desk, may be in any
    pose. The likeliest is the stance that the joints with data resemble most. A limb without data
    rests if no camera would show it at rest; else its pose is one that the picture allows.

    Args:
        body: The body.
        pose: A registered pose.
        observation: The frame.
    """
    if observation.sight is None or not len(body.capsules) or not body.stances:
        return pose
    bare = _moves_none_of(body, _with_data(body, pose, observation.points))
    step = _to_stance(body, pose, ~bare)
    for limb in limbs_of(body):
        elsewhere = np.delete(body.skeleton.dof_mask, limb.segments, axis=1).any(axis=1)
        own = bare & ~elsewhere
        if own.any():
            moved = _moved(body, pose, np.where(own, step, 0.0))
            shown = _in_sight(body, moved, observation)
            pose = moved if _moves_none_of(body, shown)[own].all() else pose
    return pose


def _moves_none_of(body: Body, segments: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Returns which degrees of freedom (n,) move none of the chosen segments, (S,)."""
    return np.asarray(~body.skeleton.dof_mask[:, segments].any(axis=1))


def _with_data(body: Body, pose: Pose, points: Array) -> NDArray[np.bool_]:
    """Returns which segments (S,) have data on their surface."""
    placed = body.capsules.place(body.place(pose).transforms)
    axes = placed.axis_points(SPACING * body.size)
    return _many(body, axes.segments, placed.supported(axes, points, NEAR * body.limb_radius))


def _in_sight(body: Body, pose: Pose, observation: Observation) -> NDArray[np.bool_]:
    """Returns which segments (S,) a camera would show."""
    assert observation.sight is not None
    axes = body.capsules.axis_points(SPACING * body.size)
    points = axes.place(body.place(pose).transforms)
    return _many(body, axes.segments, observation.sight.observable(points))


def _many(body: Body, segments: Indices, chosen: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Returns of which segments (S,) more than a few points, (M,), are chosen."""
    count = len(body.skeleton.names)
    every = np.bincount(segments, minlength=count)
    return np.asarray(np.bincount(segments, weights=chosen, minlength=count) > FEW * every)


def _to_stance(body: Body, pose: Pose, told: NDArray[np.bool_]) -> Array:
    """Returns the step (n,) to the stance that is nearest in the joints with data, (n,)."""
    stances = [Pose(pose.root, one.pose.balls, one.pose.hinges) for one in body.stances]
    steps = [body.skeleton.difference(pose, one) for one in stances]
    return min(steps, key=lambda step: float((step[told] ** 2).sum()))


def _moved(body: Body, pose: Pose, step: Array) -> Pose:
    bones = body.skeleton
    return bones.limits.projected(bones.retract(pose, step))
