"""Coefficients of distortion as drivers give them, padded with zeros."""

from __future__ import annotations

from collections.abc import Sequence

from regkit.geometry.distortion import BrownConrady, Distortion
from regkit.system.errors import DataError


def brown_conrady(coefficients: Sequence[float]) -> Distortion | None:
    """Returns the distortion of k1 k2 p1 p2 k3 ..., None if all are zero.

    OpenCV's model of 12 or 14 coefficients has terms of thin prisms and tilted sensors, which must
    be zero here.

    Raises:
        DataError: If there are more than eight that are not zero.
    """
    values = tuple(map(float, coefficients))
    if not any(values):
        return None
    if any(values[8:]):
        raise DataError(
            f"the distortion has {len(values)} coefficients, with thin prisms or a tilted sensor, "
            "which are not supported: rectify the images"
        )
    count = next(one for one in BrownConrady.counts if not any(values[one:]) or one == 8)
    return BrownConrady((*values, *[0.0] * count)[:count])
