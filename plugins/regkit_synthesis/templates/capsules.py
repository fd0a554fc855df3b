"""Tapered capsules fitted to the surface of a segment."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.optimize import least_squares

from regkit.body.deformation import REFLECT
from regkit.body.vectors import rounded
from regkit.fitting.flesh import Flesh
from regkit.geometry.capsules import Capsules
from regkit.skeleton.description import CapsuleDescription
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Piece:
    """A first guess of a capsule, or of two that mirror each other in the plane x = 0.

    Attributes:
        start: (3,) centre of the first sphere [m].
        end: (3,) centre of the second sphere [m]. radius: Of both [m]. symmetry: ``free``;
        ``pair``: the capsule and its mirror image; ``middle``: the capsule lies in
            the plane; ``across``: it is its own mirror image, and its end is that of its start.
    """

    start: tuple[float, float, float]
    end: tuple[float, float, float]
    radius: float
    symmetry: Literal["free", "pair", "middle", "across"] = "free"

    def parameters(self) -> Array:
        """The ends and the two radii, (8,) [m]."""
        return np.array([*self.start, *self.end, self.radius, self.radius])

    def capsules(self, parameters: Array) -> list[tuple[Array, Array]]:
        """The ends (2, 3) and radii (2,) of the one or two capsules of ``parameters`` (8,) [m]."""
        ends, radii = parameters[:6].reshape(2, 3), parameters[6:]
        match self.symmetry:
            case "pair":
                return [(ends, radii), (ends * REFLECT, radii)]
            case "middle":
                return [(ends * [0.0, 1.0, 1.0], radii)]
            case "across":
                return [(np.array([ends[0], ends[0] * REFLECT]), radii[[0, 0]])]
            case "free":
                return [(ends, radii)]


def fitted(
    pieces: Sequence[Piece], flesh: Flesh, scale: float, stiffness: float = 0.02
) -> tuple[CapsuleDescription, ...]:
    """The capsules whose surface together lies nearest to that of a segment.

    Least squares of the signed distances of the surface's points, made robust, with weak springs to
    the first guess: where a segment is cut off from its neighbour there is no surface that says
    where the capsule ends.

    Args:
        pieces: The first guess.
        flesh: The segment.
        scale: Distance beyond which a point counts as an outlier [m].
        stiffness: Of the springs; 1 is that of all points together.
    """
    guess = np.concatenate([piece.parameters() for piece in pieces])
    shares = np.sqrt(flesh.areas / flesh.areas.sum())
    lower = np.tile([*[-np.inf] * 6, 0.2 * scale, 0.2 * scale], len(pieces))

    def residuals(parameters: Array) -> Array:
        distances = _capsules(pieces, parameters).surface_distance(flesh.surface)
        robust = np.sqrt(2.0 * (np.sqrt(1.0 + (distances / scale) ** 2) - 1.0))
        springs = stiffness * (parameters - guess) / scale
        return np.concatenate([shares * robust, springs])

    solution = least_squares(residuals, guess, bounds=(lower, np.inf), max_nfev=60, x_scale=scale)
    found = _capsules(pieces, solution.x)
    return tuple(
        _described(ends, radii) for ends, radii in zip(found.ends, found.radii, strict=True)
    )


def _capsules(pieces: Sequence[Piece], parameters: Array) -> Capsules:
    both = [
        capsule
        for piece, own in zip(pieces, parameters.reshape(-1, 8), strict=True)
        for capsule in piece.capsules(own)
    ]
    return Capsules(
        np.zeros(len(both), dtype=np.intp),
        np.array([ends for ends, _ in both]),
        np.array([radii for _, radii in both]),
    )


def _described(ends: Array, radii: Array) -> CapsuleDescription:
    first, second = (round(float(radius), 4) for radius in radii)
    return CapsuleDescription(
        start=rounded(ends[0]),
        end=rounded(ends[1]),
        radius=first if first == second else (first, second),
    )
