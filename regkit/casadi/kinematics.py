"""Forward kinematics as CasADi functions."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

from regkit.body import Markers
from regkit.casadi import rotations
from regkit.casadi.configuration import length, split
from regkit.skeleton import Skeleton
from regkit.system.arrays import Array
from regkit.system.optional import load_library


@lru_cache(maxsize=16)
def forward_kinematics(skeleton: Skeleton) -> Any:
    """Returns the CasADi function configuration (Q,) -> T_world_segment of all segments, eq. 4.

    The matrices are concatenated horizontally, (4, 4 S), in the order of ``skeleton.names``. The
    frame of a fixed root is the world.

    Raises:
        DependencyError: If CasADi is missing.
    """
    ca = load_library("casadi")
    numbers = ca.SX.sym("configuration", length(skeleton))
    links = _links(skeleton, numbers)
    segments = [links[link] for link in skeleton.segment_links]
    return ca.Function(
        "forward_kinematics", [numbers], [ca.horzcat(*segments)],
        ["configuration"], ["transforms"],
    )  # fmt: skip


def marker_positions(skeleton: Skeleton, markers: Markers) -> Any:
    """Returns the CasADi function configuration (Q,) -> positions of all M markers, (3, M) [m].

    Raises:
        DependencyError: If CasADi is missing.
    """
    ca = load_library("casadi")
    numbers = ca.SX.sym("configuration", length(skeleton))
    transforms = forward_kinematics(skeleton)(numbers)
    places = [
        (transforms[:, 4 * segment : 4 * segment + 4] @ np.append(point, 1.0))[:3]
        for segment, point in zip(markers.segments, markers.points, strict=True)
    ]
    return ca.Function(
        "marker_positions", [numbers], [ca.horzcat(*places)], ["configuration"], ["positions"]
    )


def _links(skeleton: Skeleton, numbers: Any) -> list[Any]:
    """Returns T_world_link of each link: T_world_parent * offset * motion of the joint."""
    ca = load_library("casadi")
    parts = split(skeleton, numbers)
    moves = {
        link: _rigid(rotations.matrix(rotations.normalized(ball)), ca.SX(3, 1))
        for link, ball in zip(skeleton.ball_links, parts.balls, strict=True)
    }
    for index, (link, twist) in enumerate(
        zip(skeleton.hinge_links, skeleton.hinge_twists, strict=True)
    ):
        turned = rotations.exponential(parts.hinges[index] * twist[3:])
        moves[link] = _rigid(rotations.matrix(turned), parts.hinges[index] * twist[:3])
    if skeleton.free:
        root = _rigid(rotations.matrix(rotations.normalized(parts.rotation)), parts.position)
    else:
        root = ca.DM.eye(4)
    links: list[Any] = []
    # Parents come before their children.
    for link, above in enumerate(skeleton.link_parents):
        parent = root if above < 0 else links[above]
        placed = parent @ _constant(skeleton.link_offsets[link])
        links.append(placed @ moves[link] if link in moves else placed)
    return links


def _rigid(rotation: Any, translation: Any) -> Any:
    ca = load_library("casadi")
    return ca.vertcat(ca.horzcat(rotation, translation), ca.DM([[0.0, 0.0, 0.0, 1.0]]))


def _constant(transform: Array) -> Any:
    """Returns a constant matrix with structural zeros, which CasADi eliminates."""
    return load_library("casadi").sparsify(load_library("casadi").DM(np.asarray(transform)))
