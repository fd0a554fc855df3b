"""Poses of one body for another, joint by joint."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from regkit.body import Body
from regkit.skeleton import Pose, Skeleton
from regkit.system.arrays import Array, Indices
from regkit.system.brief import Brief
from regkit.system.errors import ConfigError

PARALLEL = 1e-3
"""Greatest difference of a component of axes that count as the same."""


@dataclass(frozen=True)
class PoseTransfer(Brief):
    """The same joint angles on another body, which may have other lengths.

    Attributes:
        goal: Skeleton of the other body.
        balls: Index among the first body's ball joints of each of the other's.
        hinges: Index among the first body's hinges of each of the other's.
    """

    goal: Skeleton
    balls: Indices
    hinges: Indices

    @classmethod
    def between(cls, source: Body, goal: Body) -> Self:
        """Returns the transfer from the poses of one body to those of another.

        Raises:
            ConfigError: If their joints differ in name or type, a hinge in its axis, or a segment
                in its rotation at rest.
        """
        ours, others = source.skeleton, goal.skeleton
        _check_names(source, goal)
        _check_rest(source, goal)
        balls = [ours.ball_names.index(name) for name in others.ball_names]
        hinges = [ours.hinge_names.index(name) for name in others.hinge_names]
        for name, own, other in zip(
            others.hinge_names, ours.hinge_twists[hinges], others.hinge_twists, strict=True
        ):
            if np.abs(own - other).max() > PARALLEL:
                raise ConfigError(
                    f"the hinge '{name}' {_told(own)} in the template '{source.name}', and "
                    f"{_told(other)} in '{goal.name}'; poses are transferred between "
                    "templates of the same joints"
                )
        return cls(others, np.array(balls, dtype=np.intp), np.array(hinges, dtype=np.intp))

    def pose(self, pose: Pose) -> Pose:
        """Returns the other body's pose with the same root and joint angles, within its limits."""
        same = Pose(pose.root, pose.balls[self.balls], pose.hinges[self.hinges])
        return self.goal.limits.projected(same)


def _check_names(source: Body, goal: Body) -> None:
    """Refuses bodies with joints that do not correspond."""
    ours, others = source.skeleton, goal.skeleton
    for what, own, other in (
        ("segment", ours.names, others.names),
        ("ball joint", ours.ball_names, others.ball_names),
        ("hinge", ours.hinge_names, others.hinge_names),
    ):
        lone = sorted(set(own) ^ set(other))
        if lone:
            having = source if lone[0] in own else goal
            raise ConfigError(
                f"only the template '{having.name}' has the {what} '{lone[0]}'; "
                f"poses of '{source.name}' are transferred to '{goal.name}' joint by joint, which "
                "needs the same segments and types of joints in both"
            )
    if ours.free != others.free:
        raise ConfigError(
            f"the root of one of the templates '{source.name}' and '{goal.name}' is free, and that "
            "of the other is not; poses are transferred between templates of the same joints"
        )


def _check_rest(source: Body, goal: Body) -> None:
    """Refuses bodies whose segments are rotated differently at rest."""
    at_rest = [
        dict(zip(body.skeleton.names, body.place(body.skeleton.rest()).transforms, strict=True))
        for body in (source, goal)
    ]
    for name, transform in at_rest[0].items():
        if np.abs(transform[:3, :3] - at_rest[1][name][:3, :3]).max() > PARALLEL:
            raise ConfigError(
                f"the frame of the segment '{name}' is rotated at rest, compared between the "
                f"templates '{source.name}' and '{goal.name}'; poses are transferred between "
                "templates whose frames are parallel at rest"
            )


def _told(twist: Array) -> str:
    """Returns what a hinge does, by its unit twist (6,)."""
    does, axis = ("slides along", twist[:3]) if twist[:3].any() else ("turns about", twist[3:])
    return f"{does} [{', '.join(f'{value:.3g}' for value in axis)}]"
