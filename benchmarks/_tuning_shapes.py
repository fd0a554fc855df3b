"""Lists of primitives that ``tuning.py`` compares, and the methods that take them."""

from __future__ import annotations

from dataclasses import dataclass

from regkit.body import (
    CapsuleParameters,
    GaussianParameters,
    IsotropicGaussianParameters,
    ShapeParameters,
)

FILLED: dict[str, tuple[type[ShapeParameters], tuple[int, ...]]] = {
    "sog": (IsotropicGaussianParameters, (26, 41)),
    "gsog": (GaussianParameters, (26, 41)),
    "sphere": (CapsuleParameters, (16, 26)),
}
"""Class and numbers of the primitives that fill the body and that no shipped template lists."""


@dataclass(frozen=True)
class Shape:
    """A list of primitives for a method.

    Attributes:
        curve: Shape model, and whether its primitives are tuned.
        count: Number of primitives.
        method: The method that takes the list, in YAML.
    """

    curve: str
    count: int
    method: str


def gaussians(curve: str, count: int, kind: str, tuned: str | None) -> Shape:
    """Returns a shape of Gaussians for the method ``best``."""
    name = "" if tuned is None else f", tuned: {tuned}"
    return Shape(curve, count, f"{{preset: best, shape: {{kind: {kind}, surface: visible{name}}}}}")


def capsules(curve: str, count: int, tuned: str | None) -> Shape:
    """Returns a shape of capsules for the method ``spheres``."""
    name = "" if tuned is None else f", shape: {{kind: sphere, tuned: {tuned}}}"
    return Shape(curve, count, f"{{preset: spheres{name}}}")


SHAPES = (
    gaussians("SoG", 26, "sog", "filled_26"),
    gaussians("SoG", 41, "sog", "filled_41"),
    gaussians("SoG", 58, "sog", None),
    gaussians("G-SoG", 13, "gsog", None),
    gaussians("G-SoG", 26, "gsog", "filled_26"),
    gaussians("G-SoG", 41, "gsog", "filled_41"),
    gaussians("G-SoG, tuned", 13, "gsog", "best"),
    gaussians("G-SoG, tuned", 26, "gsog", "best_26"),
    gaussians("G-SoG, tuned", 41, "gsog", "best_41"),
    capsules("capsules", 16, "filled_16"),
    capsules("capsules", 26, "filled_26"),
    capsules("capsules", 41, None),
    capsules("capsules, tuned", 41, "spheres"),
)
