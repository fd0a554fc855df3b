"""Matching of reference joints with a body's markers, by name and by unit."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from regkit.body import Body
from regkit.config.model import did_you_mean
from regkit.observation import Truth
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError
from regkit.system.notes import note

FACTOR = 5.0
"""Reference joints whose extent differs from the markers' by more are in another unit; joints may
be folded, or belong to another person."""


def matched(body: Body, truth: Truth, joints: Mapping[str, str]) -> tuple[list[int], list[int]]:
    """Matches reference joints with markers of the body.

    Args:
        body: The body.
        truth: Reference joints.
        joints: Marker of the body for each reference joint whose name differs.

    Returns:
        Indices of the matched reference joints, and indices of their markers.

    Raises:
        ConfigError: If ``joints`` names an unknown joint or marker, or no joint matches a marker.
    """
    for name, marker in joints.items():
        if name not in truth.joints:
            raise ConfigError(
                f"the data have no joint '{name}' (there are: {', '.join(truth.joints)})"
                + did_you_mean(name, list(truth.joints)),
                place="dataset.joints",
            )
        if marker not in body.markers.names:
            raise ConfigError(
                f"the template '{body.name}' has no marker '{marker}' (there are: "
                f"{', '.join(body.markers.names)})"
                + did_you_mean(marker, list(body.markers.names)),
                place=f"dataset.joints.{name}",
            )
    names = [joints.get(name, name) for name in truth.joints]
    pairs = [
        (column, body.markers.names.index(name))
        for column, name in enumerate(names)
        if name in body.markers.names
    ]
    if not pairs:
        raise ConfigError(
            f"no joint of the data ({', '.join(truth.joints)}) is a marker of '{body.name}' "
            f"({', '.join(body.markers.names)}); map their names (dataset.joints), or disable the "
            "comparison (dataset.compared=false)",
            place="dataset.joints",
        )
    return [column for column, _ in pairs], [marker for _, marker in pairs]


def tell_unmatched(body: Body, truth: Truth, joints: Mapping[str, str], *, place: str) -> None:
    """Tells which reference joints match no marker, and so take no part in the comparison.

    Args:
        body: The body.
        truth: Reference joints.
        joints: Marker of the body for each reference joint whose name differs.
        place: Source of the reference, for the message.

    Raises:
        ConfigError: If ``joints`` names an unknown joint or marker, or no joint matches a marker.
    """
    columns, _ = matched(body, truth, joints)
    unmatched = [name for column, name in enumerate(truth.joints) if column not in columns]
    if unmatched:
        note(
            f"reference joints that match no marker of '{body.name}' are not compared: "
            f"{', '.join(unmatched)}; map their names (dataset.joints)",
            place=place,
        )


def check_reference_unit(body: Body, truth: Truth, joints: Mapping[str, str]) -> None:
    """Refuses reference joints in another unit than the body.

    Args:
        body: The body at its size.
        truth: Reference joints.
        joints: Marker of the body for each reference joint whose name differs.

    Raises:
        DataError: If the extents of the joints and of their markers differ by more than ``FACTOR``.
    """
    columns, chosen = matched(body, truth, joints)
    markers = body.markers.place(body.place(body.skeleton.rest()).transforms)[chosen]
    extents = [
        _extent(frame[seen]) / _extent(markers[seen])
        for frame in truth.positions[:, columns]
        if (seen := np.isfinite(frame).all(axis=1)).sum() > 1 and _extent(markers[seen]) > 0.0
    ]
    ratio = float(np.median(extents)) if extents else 1.0
    if not 1.0 / FACTOR <= ratio <= FACTOR:
        raise DataError(
            f"the reference joints are {ratio:.3g} times as far apart as the markers of "
            f"'{body.name}', {body.size:.3g} m large; give the joints in metres"
        )


def _extent(points: Array) -> float:
    """Returns the diagonal [m] of the bounding box of points (N, 3)."""
    return float(np.linalg.norm(np.ptp(points, axis=0)))
