"""One look for each method, the same in all figures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from matplotlib.colors import to_hex, to_rgb

PALETTE = ("#0072B2", "#D55E00", "#009E73", "#E69F00", "#CC79A7", "#56B4E9", "#7F7F7F")
"""Okabe and Ito's colours, which the colour-blind can tell apart; yellow is too pale for paper."""

HATCHES = ("", "//", "..", "xx")
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", ">")
DASHES = ("-", "--", "-.", ":")

SHADES = (0.0, 0.4, -0.35)
"""Methods of one shape model: its colour, a lighter one, a darker one."""


@dataclass(frozen=True)
class Style:
    """How a method is drawn.

    Attributes:
        shape: The name of its shape model, or of the method if it has none.
        colour: As #rrggbb.
        hatch: Of its bars.
        marker: Of its points.
        dash: Of its lines.
    """

    shape: str
    colour: str
    hatch: str
    marker: str
    dash: str


def styles(shapes: Mapping[str, str]) -> dict[str, Style]:
    """The look of each method, by name, for the name of its shape model.

    Colours tell shape models apart, and shades, hatches and markers the methods of one. Where that
    would tell little, as there is one shape model or many methods of one, each method has its own.
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
    """A colour mixed with white, or with black where the shade is negative."""
    goal = 1.0 if shade > 0.0 else 0.0
    red, green, blue = (part + abs(shade) * (goal - part) for part in to_rgb(colour))
    return to_hex((red, green, blue))
