"""The landmarks of a frame as rows of numbers, which both forms of their energy take."""

from __future__ import annotations

import numpy as np

from regkit.body import Body
from regkit.geometry.camera import Camera
from regkit.observation import Landmarks, Observation
from regkit.system.arrays import Array

SEGMENT, POINT, TARGET, WEIGHT, SCALE, FOCAL, CENTRE = 0, 1, 4, 7, 8, 9, 11
"""Columns: the marker's segment and its place there [m]; where it is measured, [m] or [pixels]; the
weight of its residual, and its unit; the camera's focal lengths, 0 for a position in space, and its
principal point [pixels]."""

COLUMNS = 13


RELATIVE_ERROR = 0.018
"""Usual error of a landmark in units of the body's size: 3 cm of a person, 3 mm of a hand.

Detectors and templates differ by as much in what they call a joint.
"""

LEAST_PIXELS = 4.0
"""Least usual error of a landmark in the picture [pixels]."""


def landmark_table(
    body: Body,
    observation: Observation,
    *,
    weight: float = 1.0,
    error: float | None = None,
    error_px: float | None = None,
) -> Array:
    """Returns a row for each marker of a body, (M, 13); the weight of an unmeasured one is zero.

    Args:
        body: The body.
        observation: The frame's data.
        weight: Weight of a landmark of full confidence.
        error: Typical error of a position in space [m]; by default ``RELATIVE_ERROR``.
        error_px: Typical error of a position in the picture [pixels]; by default what ``error`` is
            at the distance of the data, but at least ``LEAST_PIXELS``.
    """
    markers, found = body.markers, observation.landmarks
    error = RELATIVE_ERROR * body.size if error is None else error
    if error_px is None and observation.camera is not None:
        distance = max(float(np.median(observation.points[:, 2])), error)
        error_px = max(observation.camera.fx * error / distance, LEAST_PIXELS)
    table = np.zeros((len(markers.names), COLUMNS))
    table[:, SEGMENT] = markers.segments
    table[:, POINT : POINT + 3] = markers.points
    table[:, SCALE] = 1.0
    if found is None:
        return table
    for row, name in enumerate(markers.names):
        at = found.rows.get(name)
        if at is not None and found.confidences[at] > 0.0:
            _measure(table[row], found, at, observation.camera, weight, error, error_px)
    return table


def _measure(
    row: Array,
    found: Landmarks,
    at: int,
    camera: Camera | None,
    weight: float,
    error: float,
    error_px: float | None,
) -> None:
    """Writes what is measured of a marker into its row."""
    if np.isfinite(found.positions[at]).all():
        row[TARGET : TARGET + 3], row[SCALE] = found.positions[at], error
    elif camera is not None and error_px is not None and np.isfinite(found.pixels[at]).all():
        row[TARGET : TARGET + 2], row[SCALE] = found.pixels[at], error_px
        row[FOCAL : FOCAL + 2] = camera.fx, camera.fy
        row[CENTRE : CENTRE + 2] = camera.cx, camera.cy
    else:
        return
    row[WEIGHT] = weight * found.confidences[at]
