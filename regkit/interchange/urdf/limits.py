"""The limits of the joints of a URDF file."""

from __future__ import annotations

import numpy as np

from regkit.interchange.remarks import Remarks
from regkit.interchange.urdf.xml_lines import Element

LONGEST = 1e4
"""Largest displacement of a prismatic joint, in the file's unit of length."""

TURNING = 8.0 * np.pi
"""A limit beyond this many turns may be meant in degrees [rad]."""

ENDLESS = 200.0 * np.pi
"""A limit of more than a hundred turns stands for none [rad]."""


def limits_of(
    kind: str, element: Element, name: str, remarks: Remarks
) -> tuple[float, float] | None:
    """Returns the limits of a joint whose type has some.

    Raises:
        DataError: If a prismatic joint has no travel, or a number is invalid.
    """
    if kind == "prismatic":
        return _travel(element, name)
    return _limits(element, name, remarks) if kind == "revolute" else None


def _travel(element: Element, name: str) -> tuple[float, float]:
    """Returns the limits of a prismatic joint.

    Raises:
        DataError: If they are missing, infinite, in the wrong order or beyond ``LONGEST``.
    """
    found = element.find("limit")
    if found is None:
        raise element.wrong(
            f"the prismatic joint '{name}' has no <limit>; it needs one, such as "
            '<limit lower="0" upper="0.1"/> [m]'
        )
    low, high = (_limit(found, word) for word in ("lower", "upper"))
    if not -LONGEST <= low <= high <= LONGEST:
        raise found.wrong(
            f"the prismatic joint '{name}' has the limits {low:g} to {high:g}; the lower one must "
            f"not be above the upper one, nor either beyond {LONGEST:g} m"
        )
    return low, high


def _limits(element: Element, name: str, remarks: Remarks) -> tuple[float, float] | None:
    found = element.find("limit")
    if found is None:
        remarks.add("hinges without the <limit> they need are unlimited", name, element.place)
        return None
    low, high = (_limit(found, word) for word in ("lower", "upper"))
    if low > high:
        remarks.add(
            "hinges are unlimited, because their lower limit is above the upper one",
            f"{name}: {low:g} > {high:g}",
            found.place,
        )
        return None
    if low == high:
        remarks.add(
            "hinges cannot turn, because their limits are equal; without lower and upper both "
            "are 0",
            name,
            found.place,
        )
    if low <= -ENDLESS and high >= ENDLESS:
        return None
    if low < -ENDLESS or high > ENDLESS:
        remarks.add(
            f"limits beyond {np.degrees(ENDLESS) / 360.0:.0f} turns are cut to that",
            f"'{name}': {low:g} to {high:g} rad",
            found.place,
        )
    elif low < -TURNING or high > TURNING:
        remarks.add(
            "limits are taken as radians, as the format says, which allows several turns",
            f"'{name}': {low:g} to {high:g} rad",
            found.place,
        )
    return max(low, -ENDLESS), min(high, ENDLESS)


def _limit(element: Element, attribute: str) -> float:
    text = element.attributes.get(attribute, "0").strip().lower()
    if text.lstrip("+-") in ("inf", "infinity"):
        return -np.inf if text.startswith("-") else np.inf
    return element.number(attribute, 0.0)
