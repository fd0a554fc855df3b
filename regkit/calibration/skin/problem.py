"""The joint problem: one shape and the poses in several frames, by the distances of the skin."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from regkit.body.linear_shape import LinearShape
from regkit.calibration.shared_shape import FrameEnergy, SharedShapeProblem
from regkit.calibration.skin.measured_views import MeasuredFrame
from regkit.calibration.skin.posed_skin import PosedSkin
from regkit.calibration.skin.skin_distances import SkinDistances
from regkit.calibration.skin.skin_points import SkinPoints
from regkit.skeleton import Pose
from regkit.system.arrays import Array

EVIDENCE = 3000.0
"""Number of independent distances in all frames together, more than of capsules without outlines.

With 1000, heights are off by 0.78 instead of 0.52 cm on the six people that the fit was developed
on (docs/how-to/subject.md); the skins are alike.
"""


class SkinProblem(SharedShapeProblem):
    """Distances of the skin in all frames.

    With the distances g of the data to the skin, h of the skin to the data, and o of the outline in
    the picture to the skin's rim, all in units of the cutoff, the energy of a frame is

        mean 1/2 log(1 + g^2) + mean 1/2 h^2 / (1 + h^2) + mean 1/2 o^2 / (1 + o^2),

    since the data may lack whole parts of the body, and their outline may be another thing's. An
    outline that meets no rim counts as an infinite distance.

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
        frames: Sequence[MeasuredFrame],
        poses: Sequence[Pose],
        cutoff: float,
    ) -> None:
        self._shape, self._frames = shape, frames
        self._points = SkinPoints.on(shape.mesh.faces)
        self._size = shape.size(start)
        self._cutoff = cutoff
        # A solver damps all variables alike; so a coefficient counts in proportion to the
        # displacement that it makes.
        self._unit = 1.0 / np.sqrt((shape.vertices**2).sum(axis=2).mean(axis=1))
        bounds = shape.bounds / self._unit[:, None]
        super().__init__(start / self._unit, bounds, shape.skeleton(start), poses, EVIDENCE)

    def coefficients(self, x: Array) -> Array:
        """Returns the shape's coefficients (P,) in coordinates x (m,)."""
        return np.asarray(x[: len(self._shape)] * self._unit)

    def prior(self, shape: Array) -> tuple[float, Array, Array]:
        """Returns the energy of the modes' prior, and its derivatives."""
        x, information = shape * self._unit, self._shape.information
        slope = self._unit * (information @ (x - self._shape.mean))
        return self._shape.energy(x), slope, self._unit[:, None] * information * self._unit

    def frames(self, shape: Array, poses: Sequence[Pose]) -> Iterator[FrameEnergy]:
        """Yields the energies of the frames."""
        coefficients = shape * self._unit
        for frame, pose in zip(self._frames, poses, strict=True):
            skin = PosedSkin.of(self._shape, coefficients, pose)
            sides = frame.distances(self._points, skin.vertices, self._size)
            squares = [(side.lengths / self._cutoff) ** 2 for side in sides]
            shares = [1.0 / max(len(side), 1) for side in sides]
            value = 0.5 * shares[0] * float(np.log1p(squares[0]).sum())
            curvatures = [shares[0] / (1.0 + squares[0])]
            for side, square, share in zip(sides[1:], squares[1:], shares[1:], strict=True):
                value += 0.5 * share * (float((square / (1.0 + square)).sum()) + side.lost)
                curvatures.append(share / (1.0 + square) ** 2)
            both = SkinDistances.joined(*sides)
            to_shape, to_pose = skin.rows(both)
            stiff = np.concatenate(curvatures) / self._cutoff**2
            rows = np.column_stack([to_shape * self._unit, to_pose])
            yield FrameEnergy(value, rows, stiff * both.lengths, stiff)
