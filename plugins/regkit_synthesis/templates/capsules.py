"""Fitting of tapered capsules to the surface of a segment."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import scipy

from regkit.body.deformation import REFLECT
from regkit.body.vectors import rounded
from regkit.fitting.flesh import Flesh
from regkit.geometry.capsules import Capsules
from regkit.skeleton.description import CapsuleDescription
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Piece:
    """An initial guess of a capsule, or of two that are mirror images in the plane x = 0.

    Attributes:
        start: Centre of the first sphere, (3,) [m].
        end: Centre of the second sphere, (3,) [m].
        radius: Radius of both spheres [m].
        symmetry: ``free``; ``pair``: the capsule and its mirror image; ``middle``: a capsule in the
            plane; ``across``: a capsule whose end is the mirror image of its start.
    """

    start: tuple[float, float, float]
    end: tuple[float, float, float]
    radius: float
    symmetry: Literal["free", "pair", "middle", "across"] = "free"

    def parameters(self) -> Array:
        """Returns the ends and the two radii, (8,) [m]."""
        return np.array([*self.start, *self.end, self.radius, self.radius])

    def capsules(self, parameters: Array) -> list[tuple[Array, Array]]:
        """Returns ends (2, 3) and radii (2,) of one or two capsules of ``parameters`` (8,) [m]."""
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
    """Returns the capsules whose union fits the surface of a segment best.

    The fit is a robust least-squares problem in the signed distances of surface points, with weak
    regularisation to the initial guess, because the cut to an adjacent segment has no surface that
    determines the end of a capsule.

    Args:
        pieces: The initial guess.
        flesh: The segment.
        scale: Distance beyond which a point counts as an outlier [m].
        stiffness: Strength of the regularisation; 1 is that of all points together.
    """
    guess = np.concatenate([piece.parameters() for piece in pieces])
    shares = np.sqrt(flesh.areas / flesh.areas.sum())
    lower = np.tile([*[-np.inf] * 6, 0.2 * scale, 0.2 * scale], len(pieces))

    def residuals(parameters: Array) -> Array:
        distances = _capsules(pieces, parameters).surface_distance(flesh.surface)
        robust = np.sqrt(2.0 * (np.sqrt(1.0 + (distances / scale) ** 2) - 1.0))
        springs = stiffness * (parameters - guess) / scale
        return np.concatenate([shares * robust, springs])

    solution = scipy.optimize.least_squares(
        residuals, guess, bounds=(lower, np.inf), max_nfev=60, x_scale=scale
    )
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
