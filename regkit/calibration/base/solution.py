"""The solution: one base for all frames from the poses that were tracked one by one."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from regkit.calibration.base.found import FoundBase, judged
from regkit.calibration.base.problem import BaseProblem
from regkit.geometry.rigid import inverse, log, rigid
from regkit.interfaces import Registrar, Solver
from regkit.observation import Observation
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError
from regkit.system.progress import working

ROUNDS = 4
"""Largest number of solutions, each with the effective numbers of points at the last one."""

STILL, STEADY = 3e-4, np.radians(0.03)
"""The base rests if a solution moves it by less than this, in sizes of the robot and [rad]."""


def solved(
    registrar: Registrar, frames: Sequence[Observation], tracked: Sequence[Pose], solver: Solver
) -> FoundBase:
    """Returns the base at which the energy of all frames together is least.

    Args:
        registrar: The method bound to a robot with a free root.
        frames: The data of the frames.
        tracked: The robot's pose in each of them alone.
        solver: Solver of the joint problem.

    Raises:
        ConfigError: If the method has no residuals, or no curvature.
    """
    alone = np.array([pose.root for pose in tracked])
    base, poses, rested = middle(alone), list(tracked), False
    for _ in range(ROUNDS):
        poses = [Pose(base, pose.balls, pose.hinges) for pose in poses]
        points = _effective(registrar, frames, poses)
        problem = BaseProblem(registrar, frames, poses, base, points)
        with working("fitting the base in all frames"):
            solution = solver.minimize(problem)
        moved, poses = problem.base(solution.x), problem.poses(solution.x)
        step = log(inverse(base) @ moved)
        base = moved
        rested = bool(
            np.linalg.norm(step[:3]) < STILL * registrar.body.size
            and np.linalg.norm(step[3:]) < STEADY
        )
        if rested:
            break
    covariance = problem.covariance(solution.x)
    verdict, reason, distance = judged(
        registrar.body, frames, poses, alone, covariance, rested=rested
    )
    cameras = {view.name: view.T_world_camera for one in frames for view in one.each_view}
    return FoundBase(registrar.body, base, covariance, cameras, poses, distance, verdict, reason)


def middle(roots: Array) -> Array:
    """Returns the pose in the middle of several (F, 4, 4), by medians of all numbers, (4, 4)."""
    median = np.median(roots, axis=0)
    left, _, right = np.linalg.svd(median[:3, :3])
    turn = left @ np.diag([1.0, 1.0, np.linalg.det(left @ right)]) @ right
    return rigid(turn, median[:3, 3])


def _effective(registrar: Registrar, frames: Sequence[Observation], poses: Sequence[Pose]) -> Array:
    """Returns the effective number of points of each frame, (F,).

    Raises:
        ConfigError: If the method does not know it.
    """
    counts = np.array([
        registrar.effective_points(frame, pose) for frame, pose in zip(frames, poses, strict=True)
    ])  # fmt: skip
    if np.isnan(counts).any():
        raise ConfigError(
            "the method has no residuals, by which frames are weighed; take one of ICP or of "
            "capsules, such as robots or spheres",
            place="method",
        )
    return counts
