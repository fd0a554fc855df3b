"""A few damped Gauss-Newton steps that bring an exemplar to the data, in one compiled loop."""

from __future__ import annotations

import numpy as np

from regkit.search.exemplars.pulls import pull_from_free_space, pull_to_data
from regkit.skeleton.compiled_placement import joint_twists, place_links, segment_jacobian
from regkit.skeleton.compiled_steps import retracted_balls, retracted_root, within_limits
from regkit.system.arrays import Array, Indices
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
    offsets: Array,
    parents: Indices,
    ball_links: Indices,
    hinge_links: Indices,
    hinge_axes: Array,
    dof_mask: Array,
    segment_links: Indices,
    hinge_limits: Array,
    centre: Array,
    twist_axis: Array,
    cone: Array,
    twist_limits: Array,
    capsule_segments: Indices,
    ends: Array,
    radii: Array,
    sphere_segments: Indices,
    sphere_points: Array,
    sphere_radii: Array,
    points: Array,
    image: Array,
    nearest: Array,
    intrinsics: Array,
    scales: Array,
    springs: Array,
    free_space: float,
    one_sided: bool,
) -> tuple[Array, Array, Array]:
    """Returns root (4, 4), balls (n_ball, 4) and hinges (n_hinge,) after the steps.

    Each step minimises the robust distances of the points to the capsules, how far the body is in
    free space, and springs between the joints and those of the exemplar. The first arguments are
    those of ``Skeleton`` and ``Limits``; the others those of ``pull_to_data`` and
    ``pull_from_free_space``.

    Args:
        scales: Scale of the robust distances in each step, (K,) [m].
        springs: Stiffness of the springs in each step, in units of the squared scale, (K,).
        free_space: Weight of free space against the data.
    """
    dofs, segments = dof_mask.shape
    first, hinge = 6, 6 + 3 * len(balls)
    turned = np.zeros(dofs)
    for step in range(len(scales)):
        links = place_links(
            offsets,
            parents,
            root,
            ball_links,
            balls.reshape(1, len(balls), 4),
            hinge_links,
            hinge_axes,
            hinges.reshape(1, len(hinges)),
        )[0]
        transforms = np.empty((segments, 4, 4))
        arms = np.empty((segments, 3))
        for segment in range(segments):
            transforms[segment] = links[segment_links[segment]]
            arms[segment] = transforms[segment, :3, 3] - root[:3, 3]
        blocks, gradients = np.zeros((segments, 6, 6)), np.zeros((segments, 6))
        pull_to_data(
            blocks, gradients, transforms, points, capsule_segments, ends, radii, scales[step],
            one_sided,
        )  # fmt: skip
        if free_space > 0.0:
            pull_from_free_space(
                blocks, gradients, transforms, sphere_segments, sphere_points, sphere_radii, image,
                nearest, intrinsics, scales[step], free_space,
            )  # fmt: skip
        twists = joint_twists(
            links, root[:3, 3].copy(), first, ball_links, hinge_links, hinge_axes, dofs, root
        )
        jacobian = segment_jacobian(twists, dof_mask, arms)
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
        change = -np.linalg.solve(matrix, gradient)
        for dof in range(dofs):
            most = FARTHEST if dof < 3 else WIDEST
            change[dof] = min(max(change[dof], -most), most)
        turned[first:] += change[first:]
        root = retracted_root(root, change)
        turns = np.ascontiguousarray(change[first:hinge]).reshape(len(balls), 3)
        balls, _ = within_limits(
            retracted_balls(balls, turns), centre, twist_axis, cone, twist_limits
        )
        hinges = hinges + change[hinge:]
        for index in range(len(hinges)):
            hinges[index] = min(
                max(hinges[index], hinge_limits[index, 0]), hinge_limits[index, 1]
            )
    return root, balls, hinges
