"""Moments of a solid tapered capsule."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array


def capsule_moments(ends: Array, radii: Array) -> tuple[Array, Array, Array]:
    """Returns centre (3,) [m], axes (3, 3) and standard deviations (3,) [m] of a solid capsule.

    The moments are integrated over thin discs perpendicular to the axis; a disc of radius r has the
    variance r^2/4 in each direction of its plane. The capsule's axis is the second one.

    Args:
        ends: Centres of the two spheres, (2, 3) [m].
        radii: Their radii, (2,) [m].
    """
    length = float(np.linalg.norm(ends[1] - ends[0]))
    unit = (ends[1] - ends[0]) / length if length > 0.0 else np.array([0.0, 1.0, 0.0])
    # One sphere may contain the other.
    lowest, highest = min(-radii[0], length - radii[1]), max(length + radii[1], radii[0])
    heights = np.linspace(lowest, highest, 400)
    centres = np.linspace(0.0, length, 50)
    spheres = np.linspace(radii[0], radii[1], 50)
    squares = spheres**2 - (heights[:, None] - centres) ** 2
    discs = np.maximum(squares.max(axis=1), 0.0)  # Squared radius of the solid at each height.
    mass = discs / discs.sum()
    middle = float(mass @ heights)
    along = float(mass @ (heights - middle) ** 2)
    across = float(mass @ discs) / 4.0
    helper = np.eye(3)[np.argmin(np.abs(unit))]
    side = np.cross(unit, helper)
    side /= np.linalg.norm(side)
    axes = np.column_stack([side, unit, np.cross(side, unit)])
    return ends[0] + middle * unit, axes, np.sqrt([across, along, across])
