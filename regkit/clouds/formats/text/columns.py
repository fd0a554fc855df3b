"""Names of columns: which are x, y and z, and in which unit."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

_PREFIXES = {"": 1.0, "milli": 0.001, "centi": 0.01, "deci": 0.1, "micro": 1e-6, "kilo": 1000.0}
METRES = {
    "m": 1.0, "mm": 0.001, "cm": 0.01, "dm": 0.1, "um": 1e-6, "\u00b5m": 1e-6, "km": 1000.0,
    "in": 0.0254, "inch": 0.0254, "inches": 0.0254, "ft": 0.3048, "foot": 0.3048, "feet": 0.3048,
    **{
        prefix + word: scale
        for prefix, scale in _PREFIXES.items()
        for word in ("meter", "meters", "metre", "metres")
    },
}  # fmt: skip
"""Units that a header may name, in metres."""

_STATED = re.compile(
    r"\bunits?\b\s*(?:[:=]|\bis\b|\bare\b)?\s*(?:in\s)?\s*[\[(\"']?(\w+)[\])\"'.]*\s*$"
)
"""A comment that names the unit, such as ``units: mm``."""

_UNIT = re.compile(r"(?P<name>.*?)(?:[\s_/]*[\[({](?P<a>[^\])}]*)[\])}]|[\s_/]+(?P<b>[^\W\d_]+))$")
_BEFORE = r"(?:p|pos|position|points?|points?_m_xyz|coords?|coordinates?|loc|location|vertex)"
_AFTER = r"(?:coords?|coordinates?|pos|position)"
_FAMILIES = (
    ("[xyz]",),
    (rf"{_BEFORE}[\s_.:]?[xyz]", rf"[xyz][\s_.]?{_AFTER}"),
    (rf"{_BEFORE}[\s_.:]?[012]",),
    ("(?:easting|northing|height|elevation|altitude|up|east|north)",),
)
"""Patterns of names in the order of preference."""

_AXES = {"0": 0, "1": 1, "2": 2, "x": 0, "y": 1, "z": 2}
_EARTH = {"east": 0, "easting": 0, "north": 1, "northing": 1}


@dataclass(frozen=True)
class Columns:
    """Which columns hold the coordinates.

    Attributes:
        indices: Columns of x, y and z.
        unit: The unit's name; empty if the header names none.
    """

    indices: tuple[int, int, int]
    unit: str = ""


def columns_named(names: Sequence[str], units: Sequence[str] | None = None) -> Columns | None:
    """Returns the columns whose names are x, y and z; None if there are none.

    Capitals, quotes, order and other columns do not matter. If names of several kinds are present,
    such as ``x`` and ``Points:0``, the plain ones are taken.

    Args:
        names: Names of the columns.
        units: Units of the columns, if a line of their own names them.

    Raises:
        ValueError: If an axis is named twice, or the units are unknown or differ.
    """
    split = [_split(name) for name in names]
    for family in _FAMILIES:
        found: dict[int, int] = {}
        for column, (name, _) in enumerate(split):
            axis = _axis(name, family)
            if axis is None:
                continue
            if axis in found:
                raise ValueError(
                    f"both '{names[found[axis]]}' and '{names[column]}' are {'xyz'[axis]}"
                )
            found[axis] = column
        if len(found) == 3:
            indices = (found[0], found[1], found[2])
            given = split if units is None else [("", unit) for unit in units]
            named = {given[index][1].strip("[](){} ").lower() for index in indices}
            return _with_unit(indices, named)
    return None


def are_units(cells: Sequence[str]) -> bool:
    """Returns whether all cells of a line below the header are units or empty."""
    bare = [cell.strip("[](){} ").lower() for cell in cells]
    return any(bare) and any(cell in METRES for cell in bare) and not any(map(_digits, bare))


def unit_stated(comments: Sequence[str]) -> str:
    """Returns the unit of length that one of the comments names; empty if none does."""
    for comment in comments:
        match = _STATED.search(comment.lower())
        if match is not None and match[1] in METRES:
            return match[1]
    return ""


def _digits(cell: str) -> bool:
    return any(letter.isdigit() for letter in cell)


def _split(name: str) -> tuple[str, str]:
    """Returns the name of a column in small letters, and its unit."""
    bare = name.strip().strip("\"'").strip().lower()
    match = _UNIT.fullmatch(bare)
    if match is None:
        return bare, ""
    bracketed, word = match["a"], match["b"]
    if bracketed is not None:
        return match["name"], bracketed.strip()
    return (match["name"].removesuffix(" in"), word) if word in METRES else (bare, "")


def _axis(name: str, family: tuple[str, ...]) -> int | None:
    for pattern in family:
        if re.fullmatch(pattern, name):
            if name in _EARTH or pattern.startswith("(?:east"):
                return _EARTH.get(name, 2)
            if re.fullmatch(rf"[xyz][\s_.]?{_AFTER}", name):
                return _AXES[name[0]]
            return _AXES[name[-1]]
    return None


def _with_unit(indices: tuple[int, int, int], named: set[str]) -> Columns:
    if len(named) > 1:
        raise ValueError(f"x, y and z have different units: {', '.join(sorted(named))}")
    (unit,) = named
    if not unit:
        return Columns(indices)
    if unit not in METRES:
        raise ValueError(f"unknown unit '{unit}'; use m, mm, cm, in or ft, or leave it out")
    return Columns(indices, unit)
