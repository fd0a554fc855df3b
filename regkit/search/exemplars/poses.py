"""Poses and views of a template, sampled within its own joint limits."""

from __future__ import annotations

import numpy as np

from regkit.body import Body
from regkit.geometry.rotation import from_vector, product
from regkit.search.limbs import limbs_of
from regkit.skeleton import Limits, Mirroring, Pose
from regkit.system.arrays import Array

ANYWHERE = 0.55
"""Probability that a limb is anywhere within its limits, and not near that of a stance."""

LIMB_SHAKE, TRUNK_SHAKE = 0.26, 0.2
"""Standard deviation of the joints about a stance [rad]."""


def sampled_poses(
    body: Body, random: np.random.Generator, count: int, *, symmetric: float = 0.0
) -> tuple[Array, Array]:
    """Returns ball quaternions (count, n_ball, 4) and hinge angles (count, n_hinge) [rad].

    Each is a stance of the body, or its rest pose, shaken; each limb is with some probability
    anywhere within its limits.

    Args:
        body: The body.
        random: Source of the poses.
        count: Number of poses.
        symmetric: Probability that two limbs of a two-sided body are mirror images, as in people
            who kneel, squat or sit.
    """
    bones = body.skeleton
    stances = [stance.pose for stance in body.stances] or [bones.rest()]
    chosen = random.integers(len(stances), size=count)
    balls = np.array([pose.balls for pose in stances])[chosen]
    hinges = np.array([pose.hinges for pose in stances])[chosen]
    any_balls, any_hinges = bones.limits.sampled(random, count)
    shakes = np.full(balls.shape[1], TRUNK_SHAKE)
    limbs = limbs_of(body)
    for limb in limbs:
        shakes[limb.balls] = LIMB_SHAKE
    steps = random.normal(size=(*balls.shape[:2], 3)) * shakes[:, None]
    balls = product(balls, from_vector(steps))
    hinges = hinges + _shakes_of_hinges(bones.limits) * random.normal(size=hinges.shape)
    for limb in limbs:
        rows = np.flatnonzero(random.uniform(size=count) < ANYWHERE)[:, None]
        balls[rows, limb.balls] = any_balls[rows, limb.balls]
        hinges[rows, limb.hinges] = any_hinges[rows, limb.hinges]
    if symmetric > 0.0:
        _mirror_limbs(body, random, balls, hinges, symmetric)
    for index in range(count):
        pose = bones.limits.projected(Pose(np.eye(4), balls[index], hinges[index]))
        balls[index], hinges[index] = pose.balls, pose.hinges
    return balls, hinges


def _mirror_limbs(
    body: Body, random: np.random.Generator, balls: Array, hinges: Array, share: float
) -> None:
    """Makes a share of the limbs the mirror images of their counterparts, in place."""
    mirroring = Mirroring.of(body.skeleton)
    if mirroring is None:
        return
    of_balls, of_hinges = mirroring.sides(balls, hinges)
    before = len(mirroring.balls)
    counterparts = np.concatenate([mirroring.balls, before + mirroring.hinges])
    for limb in limbs_of(body):
        first = np.concatenate([limb.balls, before + limb.hinges])[0]
        # Of two counterparts the first one stays, and a head has none.
        if counterparts[first] >= first:
            continue
        rows = np.flatnonzero(random.uniform(size=len(balls)) < share)[:, None]
        balls[rows, limb.balls] = of_balls[rows, limb.balls]
        hinges[rows, limb.hinges] = of_hinges[rows, limb.hinges]


def _shakes_of_hinges(limits: Limits) -> Array:
    """Returns the standard deviation of each hinge about a stance, (n_hinge,) [rad or m]."""
    # A prismatic joint is shaken by the part of its travel that a limb's joint is of half a turn.
    travel = np.diff(limits.hinge, axis=1)[:, 0]
    slides = np.where(np.isfinite(travel), LIMB_SHAKE / np.pi * travel, 0.0)
    return np.where(limits.prismatic, slides, LIMB_SHAKE)


def sampled_views(random: np.random.Generator, count: int, elevation: tuple[float, float]) -> Array:
    """Returns rotations R_view_body (count, 3, 3) of a camera without roll, in any heading.

    Args:
        random: Source of the views.
        count: Number of views.
        elevation: Least and greatest angle of the camera above the body's horizon [rad]; the
            directions are uniform between them.
    """
    heading = random.uniform(0.0, 2.0 * np.pi, count)
    low, high = np.sin(elevation)
    raised = np.arcsin(random.uniform(low, high, count))
    cos_h, sin_h, cos_e, sin_e = np.cos(heading), np.sin(heading), np.cos(raised), np.sin(raised)
    zero, one = np.zeros(count), np.ones(count)
    turn = np.stack([cos_h, zero, sin_h, zero, one, zero, -sin_h, zero, cos_h], axis=1)
    tilt = np.stack([one, zero, zero, zero, cos_e, -sin_e, zero, sin_e, cos_e], axis=1)
    facing = np.diag([1.0, -1.0, -1.0])
    turned = facing @ (tilt.reshape(count, 3, 3) @ turn.reshape(count, 3, 3))
    return np.asarray(turned)


def rolled(views: Array, rolls: Array) -> Array:
    """Returns rotations R_view_body (N, 3, 3) after rolls (N,) [rad] about the view's z axis."""
    turns = np.tile(np.eye(3), (len(rolls), 1, 1))
    turns[:, 0, 0] = turns[:, 1, 1] = np.cos(rolls)
    turns[:, 1, 0] = np.sin(rolls)
    turns[:, 0, 1] = -turns[:, 1, 0]
    return np.asarray(turns @ views)
