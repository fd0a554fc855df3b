"""Refinement of cameras' poses by the energy of all views together.

A frame's energy depends on the body's pose and on those of the cameras. With every pose registered
to all cameras, its derivative to the pose vanishes, and what is left is a function of the cameras
alone (variable projection). Its Gauss-Newton matrix is the Schur complement of the poses.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from regkit.geometry.rigid import exp, inverse
from regkit.geometry.rotation import skew
from regkit.interfaces import Registrar
from regkit.observation import Observation, View
from regkit.skeleton import Pose
from regkit.system.arrays import Array

ROUNDS = 15
"""Largest number of steps."""

STILL = 1e-4
"""The cameras rest if none moves farther than this [m, rad]."""

LONGEST = 0.1
"""Largest step [m, rad]."""

RESTING = 1e-6
"""Regularisation, as a fraction of the mean curvature."""


@dataclass
class Refinement:
    """The poses of cameras and of the body in some frames.

    Attributes:
        registrar: The registrar of the body.
        frames: The data of the frames, with views.
        poses: Pose of the body in each frame, in the world.
        cameras: T_camera_world (4, 4) [m] by the cameras' names; the first one is fixed.
        covariance: Inverse curvature of the cameras that move, (6 (V - 1), 6 (V - 1)).
        rounds: Number of steps.
        rested: Whether the cameras came to rest.
    """

    registrar: Registrar
    frames: Sequence[Observation]
    poses: list[Pose]
    cameras: dict[str, Array]
    covariance: Array = field(default_factory=lambda: np.zeros((0, 0)))
    rounds: int = 0
    rested: bool = False

    def run(self) -> None:
        """Moves the cameras until they rest."""
        for self.rounds in range(1, ROUNDS + 1):
            self.frames = [self._placed(one) for one in self.frames]
            self.poses = [
                self.registrar.register(frame, [pose]).pose
                for frame, pose in zip(self.frames, self.poses, strict=True)
            ]
            step = self._step()
            largest = float(np.abs(step).max(initial=0.0))
            step *= min(1.0, LONGEST / max(largest, 1e-12))
            for number, name in enumerate(list(self.cameras)[1:]):
                moved = exp(step[6 * number : 6 * number + 6])
                self.cameras[name] = moved @ self.cameras[name]
            if largest < STILL:
                self.rested = True
                return

    def _placed(self, frame: Observation) -> Observation:
        """Returns a frame with the cameras where they are now."""
        return Observation.of_views(
            [View(one.name, inverse(self.cameras[one.name]), one.data) for one in frame.views]
        )

    def _step(self) -> Array:
        """Returns the step of all cameras but the first, (6 (V - 1),), in their own frames."""
        names = list(self.cameras)
        size = 6 * (len(names) - 1)
        gradient: Array = np.zeros(size)
        matrix: Array = np.zeros((size, size))
        for frame, pose in zip(self.frames, self.poses, strict=True):
            total = float(frame.weights.sum())
            _, force, square = self.registrar.normal_equations(frame, pose)
            coupled = np.zeros((len(force), size))
            for view in frame.each_view:
                at = 6 * (names.index(view.name) - 1)
                if at < 0:
                    continue
                seen, share = pose.moved(view.to_camera), float(view.data.weights.sum()) / total
                _, own, curved = self.registrar.normal_equations(view.data, seen)
                # A camera's motion moves the body's root before it the other way.
                jacobian = _root_by_camera(seen.root)
                part = slice(at, at + 6)
                gradient[part] += share * jacobian.T @ own[:6]
                matrix[part, part] += share * jacobian.T @ curved[:6, :6] @ jacobian
                cross = curved[:, :6] @ jacobian
                cross[:3] = view.to_camera[:3, :3].T @ cross[:3]
                coupled[:, part] += share * cross
            square = square + RESTING * np.trace(square) / len(square) * np.eye(len(square))
            solved = np.linalg.solve(square, np.column_stack([coupled, force]))
            matrix -= coupled.T @ solved[:, :-1]
            gradient = np.asarray(gradient - coupled.T @ solved[:, -1])
        if not size:
            return gradient
        matrix = np.asarray(0.5 * (matrix + matrix.T))
        matrix += RESTING * np.trace(matrix) / size * np.eye(size)
        self.covariance = np.asarray(np.linalg.inv(matrix))
        return np.asarray(-self.covariance @ gradient)


def _root_by_camera(root: Array) -> Array:
    """Returns the root's motion (6, 6) by a motion of T_camera_world from the left.

    Args:
        root: T_camera_root, (4, 4) [m].
    """
    jacobian = np.zeros((6, 6))
    jacobian[:3, :3] = np.eye(3)
    jacobian[:3, 3:] = -skew(root[:3, 3])
    jacobian[3:, 3:] = root[:3, :3].T
    return jacobian
