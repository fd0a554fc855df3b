"""Forward kinematics in compiled loops; for few joints NumPy's call overhead would dominate."""

from __future__ import annotations

import numpy as np

from regkit.skeleton.compiled_rotation import exponential, set_rotation
from regkit.system.arrays import Array, Indices
from regkit.system.compiled import compiled


@compiled
def place_links(
    offsets: Array,
    parents: Indices,
    root: Array,
    ball_links: Indices,
    balls: Array,
    hinge_links: Indices,
    hinge_twists: Array,
    hinges: Array,
) -> Array:
    """Returns T_world_link (P, L, 4, 4) of P poses.

    Args:
        offsets: T_parent_joint of each link at rest, (L, 4, 4).
        parents: Parent of each link, (L,); -1 for the root.
        root: T_world_root, (4, 4).
        ball_links: Link of each ball joint, (n_ball,).
        balls: Unit quaternions of the ball joints, (P, n_ball, 4).
        hinge_links: Link of each hinge, (n_hinge,).
        hinge_twists: Unit twists of the hinges in their link frames, (n_hinge, 6).
        hinges: Angles [rad] or displacements [m] of the hinges, (P, n_hinge).
    """
    poses, count = len(hinges), len(offsets)
    links = np.empty((poses, count, 4, 4))
    rotations, places = np.empty((count, 3, 3)), np.empty((count, 3))
    rotated = np.zeros(count, dtype=np.bool_)
    for index in range(len(ball_links)):
        rotated[ball_links[index]] = True
    for index in range(len(hinge_links)):
        rotated[hinge_links[index]] = True
    local = np.empty((3, 3))
    for pose in range(poses):
        for link in range(count):
            for i in range(3):
                places[link, i] = offsets[link, i, 3]
        for index in range(len(ball_links)):
            ball = balls[pose, index]
            set_rotation(rotations[ball_links[index]], ball[0], ball[1], ball[2], ball[3])
        for index in range(len(hinge_links)):
            value, link = hinges[pose, index], hinge_links[index]
            x, y, z, w = exponential(
                value * hinge_twists[index, 3],
                value * hinge_twists[index, 4],
                value * hinge_twists[index, 5],
            )
            set_rotation(rotations[link], x, y, z, w)
            for i in range(3):
                for j in range(3):
                    places[link, i] += offsets[link, i, j] * value * hinge_twists[index, j]
        for link in range(count):
            parent = root if parents[link] < 0 else links[pose, parents[link]]
            for i in range(3):
                for j in range(3):
                    local[i, j] = 0.0 if rotated[link] else offsets[link, i, j]
                    if rotated[link]:
                        for k in range(3):
                            local[i, j] += offsets[link, i, k] * rotations[link, k, j]
            for i in range(3):
                place = 0.0
                for j in range(3):
                    entry = 0.0
                    for k in range(3):
                        entry += parent[i, k] * local[k, j]
                    links[pose, link, i, j] = entry
                    place += parent[i, j] * places[link, j]
                links[pose, link, i, 3] = parent[i, 3] + place
                links[pose, link, 3, i] = 0.0
            links[pose, link, 3, 3] = 1.0
    return links


@compiled
def joint_twists(
    links: Array,
    first: int,
    ball_links: Indices,
    hinge_links: Indices,
    hinge_twists: Array,
    dofs: int,
    root: Array,
) -> Array:
    """Returns the world twist (n, 6), linear first, of each degree of freedom at unit rate.

    The twists refer to the root's origin.

    Args:
        links: T_world_link, (L, 4, 4).
        first: Number of degrees of freedom of the root, 6 or 0.
        ball_links: Link of each ball joint, (n_ball,).
        hinge_links: Link of each hinge, (n_hinge,).
        hinge_twists: Unit twists of the hinges in their link frames, (n_hinge, 6).
        dofs: Number n of degrees of freedom.
        root: T_world_root, (4, 4).
    """
    twists = np.zeros((dofs, 6))
    if first == 6:
        for i in range(3):
            twists[i, i] = 1.0
            for j in range(3):
                twists[3 + i, 3 + j] = root[j, i]
    row, balls = first, len(ball_links)
    axis, arm, shift = np.empty(3), np.empty(3), np.zeros(3)
    for index in range(balls + len(hinge_links)):
        ball = index < balls
        link = ball_links[index] if ball else hinge_links[index - balls]
        for i in range(3):
            arm[i] = links[link, i, 3] - root[i, 3]
        for part in range(3 if ball else 1):
            for i in range(3):
                axis[i] = links[link, i, part] if ball else 0.0
                if not ball:
                    shift[i] = 0.0
                    for j in range(3):
                        shift[i] += links[link, i, j] * hinge_twists[index - balls, j]
                        axis[i] += links[link, i, j] * hinge_twists[index - balls, 3 + j]
            for i in range(3):
                j, k = (i + 1) % 3, (i + 2) % 3
                twists[row, i] = arm[j] * axis[k] - arm[k] * axis[j] + shift[i]
                twists[row, 3 + i] = axis[i]
            row += 1
    return twists


@compiled
def segment_jacobian(twists: Array, dof_mask: Array, arms: Array) -> Array:
    """Returns the Jacobian (S, 6, n) of the segments' twists about their origins.

    Args:
        twists: World twists of the degrees of freedom about the reference, (n, 6).
        dof_mask: 1 where a degree of freedom moves a segment, else 0, (n, S).
        arms: Vectors from the reference to the segments' origins, (S, 3) [m].
    """
    dofs, segments = dof_mask.shape
    jacobian = np.zeros((segments, 6, dofs))
    for segment in range(segments):
        for dof in range(dofs):
            if dof_mask[dof, segment] == 0.0:
                continue
            for i in range(3):
                j, k = (i + 1) % 3, (i + 2) % 3
                moved = twists[dof, i] + twists[dof, 3 + j] * arms[segment, k]
                jacobian[segment, i, dof] = moved - twists[dof, 3 + k] * arms[segment, j]
                jacobian[segment, 3 + i, dof] = twists[dof, 3 + i]
    return jacobian
