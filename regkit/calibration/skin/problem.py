"""The joint problem: one shape and the poses in several frames, by the distances of the skin."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from regkit.body.linear_shape import LinearShape
from regkit.calibration.skin.measured import Measured
from regkit.calibration.skin.posed_skin import PosedSkin
from regkit.calibration.skin.skin_distances import SkinDistances
from regkit.calibration.skin.skin_points import SkinPoints
from regkit.interfaces import Problem
from regkit.registration import TangentCoordinates
from regkit.skeleton import Pose
from regkit.system.arrays import Array, Indices

EVIDENCE = 1000.0
"""Number of independent distances in all frames together: neighbouring points and frames are
correlated."""

STIFFNESS = 0.05
"""Weight of a joint's rotation [rad] against a distance [cutoff]; a joint without data stays."""


class SkinProblem(Problem):
    """Distances of the skin in all frames, with priors on joint rotations and on the shape.

    With the distances g in units of the cutoff, their weights w, the joints' rotations t and the
    shape's prior energy p, the energy over F frames is

        EVIDENCE / F sum_F (sum 1/2 w log(1 + g^2) + sum 1/2 v h^2 / (1 + h^2)
                            + sum 1/2 (STIFFNESS t)^2) + p,

    with the distances g of the data to the skin and h of the skin to the data, which may lack whole
    parts of the body.

    Args:
        shape: The template's shape.
        start: Initial coefficients, (P,).
        frames: Data of F frames.
        poses: Initial poses of the body in these frames.
        cutoff: Distance beyond which data count little [m].
    """

    def __init__(
        self,
        shape: LinearShape,
        start: Array,
        frames: Sequence[Measured],
        poses: Sequence[Pose],
        cutoff: float,
    ) -> None:
        self._shape, self._frames = shape, frames
        self._points = SkinPoints.on(shape.mesh.faces)
        self._size = shape.size(start)
        self._cutoff = cutoff
        bones = shape.skeleton(start)
        self._charts = [TangentCoordinates(bones, pose) for pose in poses]
        self._weight = EVIDENCE / len(frames)
        self._spring = np.full(len(self._charts[0].origin()), STIFFNESS**2)
        self._spring[: bones.ball_dofs.start] = 0.0
        lower, upper = zip(*(chart.bounds() for chart in self._charts), strict=True)
        # A solver damps all variables alike; so a coefficient counts in proportion to the
        # displacement that it makes.
        self._unit = 1.0 / np.sqrt((shape.vertices**2).sum(axis=2).mean(axis=1))
        low, high = shape.bounds.T / self._unit
        begin = start / self._unit
        self.start = np.concatenate([begin, *(chart.origin() for chart in self._charts)])
        self.lower = np.concatenate([low, *lower])
        self.upper = np.concatenate([high, *upper])

    def coefficients(self, x: Array) -> Array:
        """Returns the shape's coefficients (P,) in coordinates x (m,)."""
        return np.asarray(x[: len(self._shape)] * self._unit)

    def poses(self, x: Array) -> tuple[Pose, ...]:
        """Returns the poses of the frames at coordinates x (m,)."""
        steps = zip(self._charts, self._steps(), strict=True)
        return tuple(chart.pose(x[own]) for chart, own in steps)

    def value_and_gradient(self, x: Array) -> tuple[float, Array]:
        """Returns the energy at coordinates x (m,) and its gradient (m,)."""
        return self.normal_equations(x)[:2]

    def normal_equations(self, x: Array) -> tuple[float, Array, Array]:
        """Returns the energy, its gradient (m,) and the Gauss-Newton matrix (m, m)."""
        shape, count = self.coefficients(x), len(self._shape)
        away = self._shape.information @ (shape - self._shape.mean)
        value = self._shape.energy(shape)
        gradient, matrix = np.zeros(len(x)), np.zeros((len(x), len(x)))
        gradient[:count] = self._unit * away
        matrix[:count, :count] = self._unit[:, None] * self._shape.information * self._unit
        for chart, frame, own in zip(self._charts, self._frames, self._steps(), strict=True):
            part = self._frame(shape, chart, frame, x[own])
            both = np.concatenate([np.arange(count), own])
            value += self._weight * part[0]
            gradient[both] += self._weight * part[1]
            matrix[np.ix_(both, both)] += self._weight * part[2]
        return value, gradient, matrix

    def projected(self, x: Array) -> Array:
        """Returns coordinates (m,) with hinges and ball joints projected onto their limits."""
        x = np.clip(x, self.lower, self.upper)
        for chart, own in zip(self._charts, self._steps(), strict=True):
            pose = chart.pose(x[own])
            within = chart.skeleton.limits.projected(pose)
            if within is not pose:
                x[own] = chart.vector(within)
        return x

    def _frame(
        self, shape: Array, chart: TangentCoordinates, frame: Measured, step: Array
    ) -> tuple[float, Array, Array]:
        """Returns a frame's energy and derivatives, to the shape and then to the pose's step."""
        skin = PosedSkin.of(self._shape, shape, chart.pose(step))
        to_skin, to_data = frame.distances(self._points, skin.vertices, self._size)
        squares = [(side.lengths / self._cutoff) ** 2 for side in (to_skin, to_data)]
        energy = 0.5 * float(np.log1p(squares[0]).mean())
        energy += 0.5 * float((squares[1] / (1.0 + squares[1])).sum()) / max(len(squares[1]), 1)
        tensions = np.concatenate(
            [
                1.0 / (1.0 + squares[0]) / len(squares[0]),
                1.0 / (1.0 + squares[1]) ** 2 / max(len(squares[1]), 1),
            ]
        )
        both = SkinDistances.joined(to_skin, to_data)
        to_shape, to_pose = skin.rows(both)
        to_step = to_pose @ chart.jacobian(step)
        rows = np.column_stack([to_shape * self._unit, to_step]) / self._cutoff
        spring = np.concatenate([np.zeros(len(shape)), self._spring])
        rest = np.concatenate([np.zeros(len(shape)), step])
        energy += 0.5 * float(spring @ rest**2)
        gradient = (tensions * both.lengths / self._cutoff) @ rows + spring * rest
        return energy, gradient, rows.T @ (tensions[:, None] * rows) + np.diag(spring)

    def _steps(self) -> list[Indices]:
        """Returns the indices of each pose's step among the coordinates."""
        dofs, first = len(self._spring), len(self._shape)
        return [first + frame * dofs + np.arange(dofs) for frame in range(len(self._charts))]
