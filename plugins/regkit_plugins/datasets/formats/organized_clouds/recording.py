"""A recording in one file of organized clouds."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from regkit.geometry.camera import MAX_DISTANCE
from regkit.interfaces import Recording
from regkit.observation import Frame, Truth
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit_plugins.datasets.formats.axes import Axes, in_camera
from regkit_plugins.datasets.formats.organized_clouds.background import StaticBackground
from regkit_plugins.datasets.formats.organized_clouds.grid import Grid, measured
from regkit_plugins.datasets.formats.organized_clouds.records import RecordFile


@dataclass(frozen=True)
class OrganizedRecording(Recording):
    """One file of organized clouds.

    Attributes:
        file: The file.
        axes: Axes of the data.
        with_camera: Whether to fit a camera to the grid of points.
        foreground: Minimum distance of the foreground to the background [m]; None keeps both.
    """

    file: RecordFile
    axes: Axes
    with_camera: bool
    foreground: float | None

    def frames(self) -> Iterator[Frame]:
        """Yields the grids of points, as depth images with a camera, or as clouds.

        The images are flipped so that the camera's x grows along their columns and y down their
        rows, regardless of their storage.
        """
        records = self.file.records()
        background = self._background(records)
        grid: Grid | None = None
        for index in range(self.length):
            place = self.file.place(index)
            points = self._points(records, index)
            seen = measured(points)
            _check_near(points[seen], place)
            if background is not None:
                seen &= background.before(points[..., 2])
            if self.with_camera and grid is None:
                grid = Grid.fitted(points, place=place)
            if grid is None:
                yield Frame(points[seen], place=place)
                continue
            points, seen = points[grid.turned], seen[grid.turned]
            depth = np.where(seen, points[..., 2], 0.0)
            yield Frame(points[seen], grid.camera, depth, place=place)

    def input_files(self) -> list[Path]:
        """Returns the file."""
        return [self.file.path]

    def truth(self) -> Truth | None:
        """Returns the markers by their names, and the joints as ``joint_0``, ``joint_1``, ...

        Non-finite or all-zero positions count as unseen.
        """
        records = self.file.records()
        positions: dict[str, Array] = {}
        for index in range(self.length):
            record = records[index]
            for marker in record["markers"][: record["marker_count"]]:
                name = marker["name"].split(b"\0")[0].decode("utf-8", "replace").strip()
                self._note(positions, index, name, marker["position"])
            for joint in record["joints"][: record["joint_count"]]:
                self._note(positions, index, f"joint_{joint['number']}", joint["position"])
        if not positions:
            return None
        return Truth(tuple(positions), np.stack(list(positions.values()), axis=1))

    def _note(self, positions: dict[str, Array], index: int, name: str, position: Array) -> None:
        if not name:
            raise DataError("a marker has no name", place=self.file.place(index))
        track = positions.setdefault(name, np.full((self.length, 3), np.nan))
        if not np.isnan(track[index]).all():
            raise DataError(f"two positions have the name '{name}'", place=self.file.place(index))
        if np.isfinite(position).all() and position.any():
            track[index] = in_camera(position, self.axes)

    def _points(self, records: np.memmap[Any, Any], index: int) -> Array:
        return in_camera(records[index]["points"], self.axes)

    def _background(self, records: np.memmap[Any, Any]) -> StaticBackground | None:
        if self.foreground is None:
            return None

        def depth_of(index: int) -> Array:
            points = self._points(records, index)
            return np.where(measured(points), points[..., 2], 0.0)

        return StaticBackground.of(depth_of, len(records), self.foreground)


def _check_near(points: Array, place: str) -> None:
    """Raises DataError if a point (N, 3) [m] is too far to be a measurement."""
    farthest = float(np.abs(points).max(initial=0.0))
    if farthest > MAX_DISTANCE:
        raise DataError(
            f"a coordinate of {farthest:g} m is beyond any measurement; dataset.record is wrong, "
            "or the file is damaged",
            place=place,
        )
