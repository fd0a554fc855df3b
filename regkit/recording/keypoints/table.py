"""Rows of keypoints, collected into arrays."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from regkit.geometry.camera import MAX_DISTANCE
from regkit.observation import Keypoints
from regkit.recording.keypoints.detectors import marker_of
from regkit.system.errors import DataError

MOST_PIXELS = 1e6
"""No picture is wider."""


class KeypointTable:
    """Collects keypoints one by one.

    Args:
        relative: Whether places in the picture are fractions of its width and height.
    """

    def __init__(self, *, relative: bool = False) -> None:
        self._relative = relative
        self._found: dict[tuple[int, str], tuple[tuple[float, ...], float]] = {}

    def add(self, frame: int, name: str, place: tuple[float, ...], confidence: float) -> None:
        """Adds a keypoint.

        Args:
            frame: Number of the frame.
            name: Name by the detector, or of a marker.
            place: Column and row, or x, y and z [m].
            confidence: Confidence; those above 1, as some detectors give, count as 1.

        Raises:
            DataError: If a value cannot be right, or the frame has two keypoints of this name.
        """
        marker = marker_of(name)
        most = MAX_DISTANCE if len(place) == 3 else MOST_PIXELS
        if not np.isfinite(place).all() or max(map(abs, place)) > most:
            raise DataError(f"no keypoint can be at {list(place)}")
        if not 0.0 <= confidence < 1e3:
            raise DataError(f"the confidence is {confidence:g}; it must be from 0 to 1")
        if (frame, marker) in self._found:
            raise DataError(f"frame {frame} has two keypoints '{marker}'")
        self._found[frame, marker] = place, min(confidence, 1.0)

    def keypoints(self, files: tuple[Path, ...]) -> Keypoints:
        """Returns all keypoints.

        Args:
            files: The files that they were read from.
        """
        names = tuple(dict.fromkeys(name for _, name in self._found))
        numbers = np.array(sorted({frame for frame, _ in self._found}), dtype=np.intp)
        rows = {int(number): row for row, number in enumerate(numbers)}
        columns = {name: column for column, name in enumerate(names)}
        shape = len(numbers), len(names)
        positions, pixels = np.full((*shape, 3), np.nan), np.full((*shape, 2), np.nan)
        confidences = np.zeros(shape)
        for (frame, name), (place, confidence) in self._found.items():
            at = rows[frame], columns[name]
            (positions if len(place) == 3 else pixels)[at] = place
            confidences[at] = confidence
        return Keypoints(names, numbers, positions, pixels, confidences, self._relative, files)
