"""A few damped Gauss-Newton steps that bring an exemplar to the data, in one compiled loop."""

from __future__ import annotations

import numpy as np

from regkit.search.exemplars.model import Bones, Grid, Hull, Spheres
from regkit.search.exemplars.pulls import pull_from_free_space, pull_to_data
from regkit.skeleton.compiled_placement import joint_twists, place_links, segment_jacobian
from regkit.skeleton.compiled_steps import retracted_balls, retracted_root, within_limits
from regkit.system.arrays import Array
from regkit.system.compiled import compiled

DAMPING, FLOOR = 0.02, 1e-3
"""Levenberg-Marquardt damping, relative to the diagonal and to its mean."""

FARTHEST, WIDEST = 0.15, 0.5
"""Largest step of the root's position [m] and of any angle [rad]."""


@compiled
def refined(
    root: Array,
    balls: Array,
    hinges: Array,
    bones: Bones,
    hull: Hull,
    spheres: Spheres,
    points: Array,
    grid: Grid,
    scales: Array,
    springs: Array,
    free_space: float,
    one_sided: bool,
) -> tuple[Array, Array, Array]:
    """Returns root (4, 4), balls (n_ball, 4) and hinges (n_hinge,) after the steps.

    Each step minimises the robust distances of the points to the capsules, how far the body is in
    free space, and springs between the joints and those of the exemplar.

    Args:
        root: T_camera_root of the exemplar, (4, 4).
        balls: Its ball quaternions, (n_ball, 4).
        hinges: Its hinge angles, (n_hinge,) [rad].
        bones: Kinematics and limits of the body.
        hull: Its capsules.
        spheres: Spheres on the capsules' axes.
        points: The data in the camera's frame, (M, 3) [m].
        grid: The data as blocks.
        scales: Scale of the robust distances in each step, (K,) [m].
        springs: Stiffness of the springs in each step, in units of the squared scale, (K,).
        free_space: Weight of free space against the data.
        one_sided: Whether the data show only the side that faces the camera.
    """
    dofs, segments = bones.dof_mask.shape
    first, hinge = 6, 6 + 3 * len(balls)
    turned = np.zeros(dofs)
    for step in range(len(scales)):
        links = place_links(
            bones.offsets,
            bones.parents,
            root,
            bones.ball_links,
            balls.reshape(1, len(balls), 4),
            bones.hinge_links,
            bones.hinge_axes,
            hinges.reshape(1, len(hinges)),
        )[0]
        transforms = np.empty((segments, 4, 4))
        arms = np.empty((segments, 3))
        for segment in range(segments):
            transforms[segment] = links[bones.segment_links[segment]]
            arms[segment] = transforms[segment, :3, 3] - root[:3, 3]
        blocks, gradients = np.zeros((segments, 6, 6)), np.zeros((segments, 6))
        pull_to_data(blocks, gradients, transforms, points, hull, scales[step], one_sided)
        if free_space > 0.0:
            pull_from_free_space(
                blocks, gradients, transforms, spheres, grid, scales[step], free_space
            )
        twists = joint_twists(
            links,
            root[:3, 3].copy(),
            first,
            bones.ball_links,
            bones.hinge_links,
            bones.hinge_axes,
            dofs,
            root,
        )
        jacobian = segment_jacobian(twists, bones.dof_mask, arms)
        matrix, gradient = np.zeros((dofs, dofs)), np.zeros(dofs)
        for segment in range(segments):
            matrix += jacobian[segment].T @ (blocks[segment] @ jacobian[segment])
            gradient += jacobian[segment].T @ gradients[segment]
        floor = FLOOR * np.trace(matrix) / dofs
        for dof in range(dofs):
            if dof >= first:
                matrix[dof, dof] += springs[step] * scales[step] ** 2
                gradient[dof] += springs[step] * scales[step] ** 2 * turned[dof]
            matrix[dof, dof] += DAMPING * matrix[dof, dof] + floor
        change = np.zeros(dofs)
        change -= np.linalg.solve(matrix, gradient)
        for dof in range(dofs):
            most = FARTHEST if dof < 3 else WIDEST
            change[dof] = min(max(change[dof], -most), most)
        turned[first:] += change[first:]
        root = retracted_root(root, change)
        turns = change[first:hinge].copy().reshape(len(balls), 3)
        balls, _ = within_limits(
            retracted_balls(balls, turns),
            bones.centre,
            bones.twist_axis,
            bones.cone,
            bones.twist_limits,
        )
        hinges = hinges + change[hinge:]
        for index in range(len(hinges)):
            low, high = bones.hinge_limits[index]
            hinges[index] = min(max(hinges[index], low), high)
    return root, balls, hinges
