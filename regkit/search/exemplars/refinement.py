"""A few damped Gauss-Newton steps that bring an exemplar to the data."""

from __future__ import annotations

import numpy as np

from regkit.body import Body
from regkit.search.exemplars.model import Grid, Hull, Spheres
from regkit.search.exemplars.normal_equations import add_segments, solve
from regkit.search.exemplars.pulls import pull_from_free_space, pull_to_data
from regkit.skeleton import Pose
from regkit.skeleton.compiled_placement import joint_twists, place_links, segment_jacobian
from regkit.skeleton.compiled_steps import retracted_balls, retracted_root, within_limits
from regkit.system.arrays import Array

DAMPING, FLOOR = 0.02, 1e-3
"""Levenberg-Marquardt damping, relative to the diagonal and to its mean."""

FARTHEST, WIDEST = 0.15, 0.5
"""Largest step of the root's position [m] and of any angle [rad]."""


def refined(
    body: Body,
    pose: Pose,
    spheres: Spheres,
    points: Array,
    grid: Grid,
    scales: Array,
    springs: Array,
    free_space: float,
    one_sided: bool,
) -> Pose:
    """Returns a pose after the steps, with couplings as the steps leave them.

    Each step minimises the robust distances of the points to the capsules, how far the body is in
    free space, and springs between the joints and those of the exemplar. The steps call the
    compiled loops directly, because there are many of them and each takes a fifth of a millisecond.

    Args:
        body: The body.
        pose: Pose of the exemplar in the camera's frame.
        spheres: Spheres on the capsules' axes.
        points: The data in the camera's frame, (M, 3) [m].
        grid: The data as blocks.
        scales: Scale of the robust distances in each step, (K,) [m].
        springs: Stiffness of the springs in each step, in units of the squared scale, (K,).
        free_space: Weight of free space against the data.
        one_sided: Whether the data show only the side that faces the camera.
    """
    bones, limits, hull = body.skeleton, body.skeleton.limits, Hull.of(body)
    balls_of, hinges_of, dofs = bones.ball_dofs, bones.hinge_dofs, bones.dofs
    count, first = len(bones.segment_links), balls_of.start
    joints = (bones.ball_links, bones.hinge_links, bones.hinge_twists)
    most = np.full(dofs, WIDEST)
    most[:3] = FARTHEST
    root, balls, hinges = pose.root, pose.balls, pose.hinges
    turned = np.zeros(dofs - first)
    for scale, spring in zip(scales.tolist(), (springs * scales**2).tolist(), strict=True):
        links = place_links(
            bones.link_offsets,
            bones.link_parents,
            root,
            bones.ball_links,
            balls[None],
            bones.hinge_links,
            bones.hinge_twists,
            hinges[None],
        )[0]
        transforms = links[bones.segment_links]
        blocks, gradients = np.zeros((count, 6, 6)), np.zeros((count, 6))
        pull_to_data(blocks, gradients, transforms, points, hull, scale, one_sided)
        if free_space > 0.0:
            pull_from_free_space(blocks, gradients, transforms, spheres, grid, scale, free_space)
        twists = joint_twists(links, first, *joints, dofs, root)
        arms = transforms[:, :3, 3] - root[:3, 3]
        jacobian = segment_jacobian(twists, bones.dof_mask, arms)
        matrix, change = np.zeros((dofs, dofs)), np.zeros(dofs)
        add_segments(matrix, change, jacobian, bones.dof_mask, blocks, gradients)
        diagonal = matrix.reshape(-1)[:: dofs + 1]
        floor = FLOOR * diagonal.sum() / dofs
        diagonal[first:] += spring
        change[first:] += spring * turned
        diagonal += DAMPING * diagonal + floor
        solve(matrix, change)
        change = np.minimum(np.maximum(-change, -most), most)
        turned += change[first:]
        root = retracted_root(root, change)
        balls, _ = within_limits(
            retracted_balls(balls, change[balls_of].reshape(-1, 3)),
            limits.centre,
            limits.twist_axis,
            limits.cone,
            limits.twist,
        )
        hinges = np.minimum(
            np.maximum(hinges + change[hinges_of], limits.hinge[:, 0]), limits.hinge[:, 1]
        )
    return Pose(root, balls, hinges)
