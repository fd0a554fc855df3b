"""Comparison of the extent of the data with a template's sizes, made before any search."""

from __future__ import annotations

import numpy as np

from regkit.interfaces import Template
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.notes import note

LARGEST, SMALLEST = 200.0, 0.1
"""Data whose extent is larger or smaller, in sizes of the template, are refused: a body in a large
hall is within the first, a fist or a crouching person within the second."""

LARGE, SMALL = 1.4, 0.6
"""Data of a body alone are hardly larger than this, with raised arms, or smaller, with folded
limbs; what is beyond is told."""

NARROW = 1.005
"""A size within this factor of an end of the range is at the end."""


def check_unit(points: Array, template: Template, *, place: str) -> None:
    """Refuses data in another unit than the template.

    Args:
        points: The data, (N, 3) [m], the body and possibly its surroundings.
        template: The template.
        place: Source of the data, for messages.

    Raises:
        DataError: If the data are much larger or smaller than the template.
    """
    sizes = template.candidate_sizes()
    extent = extent_of(points)
    if extent > LARGEST * sizes[-1]:
        raise DataError(
            f"{_compared(extent, template)}: give metres; "
            "millimetres are divided by 1000 (depth_scale)",
            place=place,
        )
    if extent < SMALLEST * sizes[0]:
        raise DataError(
            f"{_compared(extent, template)}: give metres (depth_scale), or another template or "
            "size",
            place=place,
        )


def check_extent(points: Array, template: Template, *, place: str) -> None:
    """Compares the data with the sizes of a template; an unlikely extent is told as a warning.

    Of several bodies, which may be far apart, the extent tells nothing but the unit.

    Args:
        points: The data, (N, 3) [m], the body and possibly its surroundings.
        template: The template.
        place: Source of the data, for messages.

    Raises:
        DataError: If the data are so large or small that their unit or the template is wrong.
    """
    check_unit(points, template, place=place)
    if template.free_bodies():
        return
    sizes, extent = template.candidate_sizes(), extent_of(points)
    advice = "check the unit of the data (depth_scale) and the template"
    if extent > LARGE * sizes[-1] * _extension(template):
        told = f"crop the surroundings (preprocessor.crop), or {advice}"
    elif extent < SMALL * sizes[0]:
        told = f"unless only a part of the body is in view, {advice}"
    else:
        return
    note(f"{_compared(extent, template)}; {told}", place=place)


def tell_bound(size: float, template: Template, *, place: str) -> None:
    """Tells that a found size is at an end of the template's range, where the search stops.

    Args:
        size: The found size [m].
        template: The template.
        place: Source of the data, for the message.
    """
    sizes = template.candidate_sizes()
    if len(sizes) > 1 and not sizes[0] * NARROW < size < sizes[-1] / NARROW:
        note(
            f"the size that fits best, {size:.3g} m, is at an end of '{template.name()}'s range; "
            "unless the body has it, check the unit of the data (depth_scale), the crop and the "
            "template",
            place=place,
        )


def _extension(template: Template) -> float:
    """Returns how much longer a body is with the further parts that it may have."""
    longer = template.extended()
    if longer is None:
        return 1.0
    with_parts, without = (
        body.capsules.place(body.place(body.skeleton.rest()).transforms).ends.reshape(-1, 3)
        for body in (one.body(one.candidate_sizes()[0]) for one in (longer, template))
    )
    return extent_of(with_parts) / extent_of(without)


def _compared(extent: float, template: Template) -> str:
    sizes = template.candidate_sizes()
    length = f"{extent:.0f}" if extent >= 100.0 else f"{extent:.3g}"
    span = f"{sizes[0]:.3g}" + (f" to {sizes[-1]:.3g}" if len(sizes) > 1 else "")
    return (
        f"the points are spread over {length} m, and the body '{template.name()}' is {span} m large"
    )


def extent_of(points: Array) -> float:
    """Returns the length [m] of points (N, 3) along their longest axis, without stray points."""
    low, high = np.percentile(points, [1.0, 99.0], axis=0)
    kept = points[((points >= low) & (points <= high)).all(axis=1)]
    # Few points may all lie on the edges of the box.
    centred = kept - kept.mean(axis=0) if len(kept) > 3 else points - points.mean(axis=0)
    _, _, axes = np.linalg.svd(centred[:: max(1, len(centred) // 2000)], full_matrices=False)
    low, high = np.percentile(centred @ axes[0], [0.0, 100.0])
    return float(high - low)
