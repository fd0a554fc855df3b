"""Forward kinematics in compiled loops: on a few joints NumPy's calls cost more than their work."""

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
    hinge_axes: Array,
    hinges: Array,
) -> Array:
    """T_world_link of P poses, (P, L, 4, 4), for balls (P, n_ball, 4) and hinges (P, n_hinge)."""
    poses, count = len(hinges), len(offsets)
    links = np.empty((poses, count, 4, 4))
    turns = np.empty((count, 3, 3))
    turned = np.zeros(count, dtype=np.bool_)
    turned[ball_links] = True
    turned[hinge_links] = True
    local = np.empty((3, 3))
    for pose in range(poses):
        for index in range(len(ball_links)):
            x, y, z, w = balls[pose, index]
            set_rotation(turns[ball_links[index]], x, y, z, w)
        for index in range(len(hinge_links)):
            angle = hinges[pose, index]
            x, y, z, w = exponential(
                angle * hinge_axes[index, 0],
                angle * hinge_axes[index, 1],
                angle * hinge_axes[index, 2],
            )
            set_rotation(turns[hinge_links[index]], x, y, z, w)
        for link in range(count):
            parent = root if parents[link] < 0 else links[pose, parents[link]]
            offset = offsets[link]
            for i in range(3):
                for j in range(3):
                    if turned[link]:
                        local[i, j] = (
                            offset[i, 0] * turns[link, 0, j]
                            + offset[i, 1] * turns[link, 1, j]
                            + offset[i, 2] * turns[link, 2, j]
                        )
                    else:
                        local[i, j] = offset[i, j]
            own = links[pose, link]
            for i in range(3):
                for j in range(3):
                    own[i, j] = (
                        parent[i, 0] * local[0, j]
                        + parent[i, 1] * local[1, j]
                        + parent[i, 2] * local[2, j]
                    )
                own[i, 3] = parent[i, 3] + (
                    parent[i, 0] * offset[0, 3]
                    + parent[i, 1] * offset[1, 3]
                    + parent[i, 2] * offset[2, 3]
                )
                own[3, i] = 0.0
            own[3, 3] = 1.0
    return links


@compiled
def joint_twists(
    links: Array,
    reference: Array,
    first: int,
    ball_links: Indices,
    hinge_links: Indices,
    hinge_axes: Array,
    dofs: int,
    root: Array,
) -> Array:
    """The world twists (n, 6) about a reference of the dofs at unit rate."""
    twists = np.zeros((dofs, 6))
    if first == 6:
        for i in range(3):
            twists[i, i] = 1.0
            for j in range(3):
                twists[3 + i, 3 + j] = root[j, i]
    row = first
    axis = np.empty(3)
    for index in range(len(ball_links) + len(hinge_links)):
        ball = index < len(ball_links)
        link = links[ball_links[index]] if ball else links[hinge_links[index - len(ball_links)]]
        x, y, z = link[0, 3] - reference[0], link[1, 3] - reference[1], link[2, 3] - reference[2]
        for part in range(3 if ball else 1):
            for i in range(3):
                if ball:
                    axis[i] = link[i, part]
                else:
                    own = hinge_axes[index - len(ball_links)]
                    axis[i] = link[i, 0] * own[0] + link[i, 1] * own[1] + link[i, 2] * own[2]
            twists[row, 0] = y * axis[2] - z * axis[1]
            twists[row, 1] = z * axis[0] - x * axis[2]
            twists[row, 2] = x * axis[1] - y * axis[0]
            twists[row, 3:] = axis
            row += 1
    return twists


@compiled
def segment_jacobian(twists: Array, moves: Array, arms: Array) -> Array:
    """(S, 6, n) of the dofs' twists (n, 6), of what they move (n, S), and of arms (S, 3)."""
    dofs, segments = moves.shape
    jacobian = np.zeros((segments, 6, dofs))
    for segment in range(segments):
        x, y, z = arms[segment]
        for freedom in range(dofs):
            if moves[freedom, segment] == 0.0:
                continue
            v0, v1, v2, w0, w1, w2 = twists[freedom]
            jacobian[segment, 0, freedom] = v0 + w1 * z - w2 * y
            jacobian[segment, 1, freedom] = v1 + w2 * x - w0 * z
            jacobian[segment, 2, freedom] = v2 + w0 * y - w1 * x
            jacobian[segment, 3, freedom] = w0
            jacobian[segment, 4, freedom] = w1
            jacobian[segment, 5, freedom] = w2
    return jacobian
