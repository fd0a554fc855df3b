"""Proportions, marker places and poses of a few frames, fitted together to measured markers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.body.body import Markers
from regkit.calibration.shape import Shape
from regkit.registration.tangent import TangentCoordinates
from regkit.skeleton import Pose
from regkit.system.arrays import Array, Indices

NOISE = 0.01
"""Usual distance of a measured marker from a rigid body [m]: skin moves over bone."""

LOOSE = 0.03
"""Usual distance of a marker's real place from the one in the marker set [m]."""

ITERATIONS, TOLERANCE = 30, 1e-4
"""Largest number of steps, and the relative decrease that ends them."""

STEP = 1e-4
"""Step of the differences to the proportions."""


@dataclass(frozen=True)
class MarkerProblem:
    """Damped Gauss-Newton on everything together: poses and lengths are too strongly coupled.

    Attributes:
        shape: The template's proportions as variables.
        segments: Segment of each marker, (M,).
        measured: Measured places in K frames, (K, M, 3) [m]; NaN where unmeasured.
        guess: Places in the marker set at the subject's size, (M, 3) [m].
    """

    shape: Shape
    segments: Indices
    measured: Array
    guess: Array

    def solved(self, x: Array, poses: list[Pose]) -> tuple[Array, Array, list[Pose]]:
        """Returns proportions (1 + 2 G), marker places (M, 3) [m] and poses of least cost.

        Args:
            x: Proportions at the start, (1 + 2 G).
            poses: Poses at the start.
        """
        places, factor = self.guess.copy(), 1e-3
        cost = self._cost(x, places, poses)
        for _ in range(ITERATIONS):
            matrix, gradient = self._equations(x, places, poses)
            while factor < 1e6:
                damped = matrix + factor * np.diag(np.diag(matrix) + 1e-6)
                step = np.asarray(np.linalg.solve(damped, -gradient))
                tried = self._moved(x, places, poses, step)
                new = self._cost(*tried)
                if new < cost:
                    break
                factor *= 10.0
            else:
                break
            (x, places, poses), gain, cost = tried, cost - new, new
            factor = max(0.1 * factor, 1e-6)
            if gain < TOLERANCE * cost:
                break
        return x, places, poses

    def residuals(self, x: Array, places: Array, poses: list[Pose]) -> Array:
        """Returns the displacements of all markers, (K, M, 3) [m]; zero where unmeasured."""
        body = self.shape.body(x)
        found = np.array([self._world(body, places, pose) for pose in poses])
        return np.nan_to_num(found - self.measured)

    def _cost(self, x: Array, places: Array, poses: list[Pose]) -> float:
        data = (self.residuals(x, places, poses) ** 2).sum() / NOISE**2
        loose = ((places - self.guess) ** 2).sum() / LOOSE**2
        return 0.5 * float(data + loose + x**2 @ self.shape.springs())

    def _world(self, body: Body, places: Array, pose: Pose) -> Array:
        """Returns the markers in the world, (M, 3) [m]."""
        return Markers((), self.segments, places).place(body.place(pose).transforms)

    def _equations(self, x: Array, places: Array, poses: list[Pose]) -> tuple[Array, Array]:
        """Returns the normal matrix and the gradient of the proportions, places and poses."""
        body = self.shape.body(x)
        others = [self.shape.body(x + STEP * unit) for unit in np.eye(len(x))]
        charts = [TangentCoordinates(body.skeleton, pose) for pose in poses]
        own, count, width = len(charts[0].origin()), len(places), len(x) + places.size
        size = width + own * len(poses)
        matrix, gradient = np.zeros((size, size)), np.zeros(size)
        segments = self.segments
        for index, (pose, chart) in enumerate(zip(poses, charts, strict=True)):
            placement = body.place(pose)
            world = self._world(body, places, pose)
            seen = np.isfinite(self.measured[index]).all(axis=1)
            jacobian = np.zeros((count, 3, width + own))
            for column, other in enumerate(others):
                jacobian[:, :, column] = (self._world(other, places, pose) - world) / STEP
            turns = placement.transforms[segments, :3, :3]
            for marker in range(count):
                at = len(x) + 3 * marker
                jacobian[marker, :, at : at + 3] = turns[marker]
            rows = placement.rows(
                np.repeat(segments, 3), np.repeat(world, 3, axis=0), np.tile(np.eye(3), (count, 1))
            )
            jacobian[:, :, width:] = (rows @ chart.jacobian(chart.origin())).reshape(count, 3, own)
            flat = jacobian[seen].reshape(-1, width + own) / NOISE
            residual = (world - self.measured[index])[seen].ravel() / NOISE
            columns = np.r_[0:width, width + own * index : width + own * (index + 1)]
            matrix[np.ix_(columns, columns)] += flat.T @ flat
            gradient[columns] += flat.T @ residual
        prior = np.concatenate([self.shape.springs(), np.full(places.size, LOOSE**-2.0)])
        matrix[np.arange(width), np.arange(width)] += prior
        gradient[:width] += prior * np.concatenate([x, (places - self.guess).ravel()])
        return matrix, gradient

    def _moved(
        self, x: Array, places: Array, poses: list[Pose], step: Array
    ) -> tuple[Array, Array, list[Pose]]:
        """Returns everything after a step, with the joints within their limits."""
        width = len(x) + places.size
        moved = places + step[len(x) : width].reshape(-1, 3)
        found = []
        for pose, own in zip(poses, step[width:].reshape(len(poses), -1), strict=True):
            chart = TangentCoordinates(self.shape.body(x).skeleton, pose)
            found.append(chart.skeleton.limits.projected(chart.pose(own)))
        return x + step[: len(x)], moved, found
