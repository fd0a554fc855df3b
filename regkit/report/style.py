"""Styles of methods, the same in all figures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

PALETTE = ("#0072B2", "#D55E00", "#009E73", "#E69F00", "#CC79A7", "#56B4E9", "#7F7F7F")
"""The colour-blind safe palette of Okabe and Ito, without yellow, which is too pale."""

HATCHES = ("", "//", "..", "xx")
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", ">")
DASHES = ("-", "--", "-.", ":")

SHADES = (0.0, 0.4, -0.35)
"""Shades of methods with the same shape model: its colour, a lighter one, a darker one."""


@dataclass(frozen=True)
class Style:
    """The style of a method.

    Attributes:
        shape: Name of its shape model, or of the method if it has none.
        colour: Colour as #rrggbb.
        hatch: Hatch of its bars.
        marker: Marker of its points.
        dash: Dash pattern of its lines.
    """

    shape: str
    colour: str
    hatch: str
    marker: str
    dash: str


def styles(shapes: Mapping[str, str]) -> dict[str, Style]:
    """Returns the style of each method.

    Colours distinguish shape models, and shades, hatches and markers the methods of one shape
    model. With a single shape model, or many methods of one, each method has its own colour.

    Args:
        shapes: Name of the shape model by method.
    """
    families = list(dict.fromkeys(shapes.values()))
    sizes = [list(shapes.values()).count(family) for family in families]
    by_shape = len(families) > 1 and max(sizes) <= len(SHADES) and len(families) <= len(PALETTE)
    found: dict[str, Style] = {}
    for index, (name, shape) in enumerate(shapes.items()):
        if by_shape:
            nth = sum(style.shape == shape for style in found.values())
            colour = _shaded(PALETTE[families.index(shape)], SHADES[nth])
        else:
            nth = index // len(PALETTE)
            colour = PALETTE[index % len(PALETTE)]
        found[name] = Style(
            shape=shape,
            colour=colour,
            hatch=HATCHES[nth % len(HATCHES)],
            marker=MARKERS[index % len(MARKERS)],
            dash=DASHES[nth % len(DASHES)],
        )
    return found


def _shaded(colour: str, shade: float) -> str:
    """Returns a colour ``#RRGGBB`` mixed with white, or with black if the shade is negative."""
    goal = 255.0 if shade > 0.0 else 0.0
    parts = bytes.fromhex(colour.removeprefix("#"))
    return "#" + bytes(round(part + abs(shade) * (goal - part)) for part in parts).hex()
