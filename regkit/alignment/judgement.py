"""Whether two clouds were aligned: the verdict of an alignment, and its reason."""

from __future__ import annotations

import numpy as np

from regkit.alignment.alignment import Alignment
from regkit.body.verdict import Verdict
from regkit.geometry.rigid import inverse
from regkit.geometry.rotation import from_matrix, to_vector

MIN_FITNESS = 0.05
"""Fraction of the source on the target below which no alignment was found."""

MIN_OVERLAP = 0.3
"""Mean fraction of both clouds on the other below which a wrong alignment may look as good."""

NOTHING = 0.1
"""A deformation that moves no point by this part of the correspondence distance does nothing."""

LARGE = 0.3
"""A mean displacement above this part of the radius of gyration is no correction of a shape."""


def judged(found: Alignment, min_fitness: float = MIN_FITNESS) -> tuple[Verdict, str]:
    """Returns whether the clouds were aligned, and the reason if that is not certain.

    Args:
        found: The alignment.
        min_fitness: Fraction of the source on the target below which no alignment was found.
    """
    agreement = found.agreement
    if agreement.fitness < min_fitness:
        return Verdict.LOST, (
            f"no alignment was found: {100.0 * agreement.fitness:.0f} % of the source lies within "
            f"{agreement.distance:.3g} of the target, and --min-fitness is {min_fitness:g}; try "
            "another start (--start), and check that both clouds show the same object"
        )
    doubts = []
    both = 0.5 * (agreement.fitness + agreement.overlap)
    if both < MIN_OVERLAP:
        doubts.append(
            f"only {100.0 * both:.0f} % of the clouds overlap, and a wrong alignment may reach as "
            "much"
        )
    if found.rivals:
        doubts.append(_ambiguity(found))
    if found.hidden is not None:
        doubts.append(
            f"{found.hidden} of the source slides its surface along itself: that part of the "
            "transform is not determined by the data"
        )
    if found.displacement is not None:
        doubts += _of_deformation(found, *found.displacement)
    if not found.converged:
        doubts.append(f"the method did not converge: {found.message}")
    return (Verdict.DOUBTFUL, "; ".join(doubts)) if doubts else (Verdict.FOUND, "")


def _of_deformation(found: Alignment, mean: float, largest: float) -> list[str]:
    """Returns the doubts about a deformation with a mean and a largest displacement [m]."""
    distance = found.agreement.distance
    if largest < NOTHING * distance:
        return [
            f"the deformation does nothing: it moves no point by more than {largest:.2g}, and "
            f"correspondences are up to {distance:.3g} apart"
        ]
    if mean > LARGE * found.radius:
        return [
            f"the deformation moves the points by {mean:.3g} on average, "
            f"{100.0 * mean / found.radius:.0f} % of the object's radius of gyration: it may have "
            "bent a wrong alignment onto the target"
        ]
    return []


def _ambiguity(found: Alignment) -> str:
    """Returns in words how another transform differs that explains the clouds nearly as well."""
    rival = found.rivals[0]
    change = inverse(found.transform) @ rival.transform
    turn = float(np.degrees(np.linalg.norm(to_vector(from_matrix(change[:3, :3])))))
    both = 0.5 * (rival.agreement.fitness + rival.agreement.overlap)
    return (
        f"another transform, {turn:.0f} degrees away, explains the clouds nearly as well "
        f"({100.0 * both:.0f} % overlap): the object may be symmetric"
    )
