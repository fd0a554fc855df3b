"""The keypoints of common detectors, and the markers of the shipped templates that they are."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from regkit.config.yaml import read_mapping
from regkit.system.errors import DataError

FILE = Path(__file__).with_name("detectors.yaml")

Detector = dict[str, str | None]
"""Marker of each keypoint in the detector's order; None for one without a marker."""


@cache
def detectors() -> dict[str, Detector]:
    """Returns the known detectors by name."""
    return read_mapping(FILE)[0]


def detector_of(prefix: str, count: int) -> Detector:
    """Returns the detector whose results hold a number of keypoints.

    Args:
        prefix: Begin of its name.
        count: Number of keypoints.

    Raises:
        DataError: If there is none.
    """
    known = {len(one): one for name, one in detectors().items() if name.startswith(prefix)}
    if count not in known:
        numbers = " or ".join(map(str, sorted(known)))
        raise DataError(f"{count} keypoints; {prefix} finds {numbers}")
    return known[count]


def marker_of(name: str) -> str:
    """Returns the marker that a keypoint is in any detector's words, or its own name.

    Letters' case is ignored: MediaPipe writes its names both ways.
    """
    return _markers().get(name.lower(), name)


@cache
def _markers() -> dict[str, str]:
    return {
        name.lower(): marker
        for one in detectors().values()
        for name, marker in one.items()
        if marker is not None
    }
