"""The files of ITOP, and their runs of frames."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from regkit.geometry.camera import Camera
from regkit.interfaces import Recording
from regkit.observation import Frame, Truth
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit_plugins.datasets.formats import hdf5

JOINTS = (
    "head", "neck", "right_shoulder", "left_shoulder", "right_elbow", "left_elbow",
    "right_hand", "left_hand", "torso", "right_hip", "left_hip", "right_knee", "left_knee",
    "right_foot", "left_foot",
)  # fmt: skip
"""The 15 joints in order."""


@dataclass(frozen=True)
class Run:
    """Consecutive frames of one person.

    Attributes:
        person: The person's number as a string.
        number: Number of the first frame.
        indices: Indices of the frames in the files.
    """

    person: str
    number: int
    indices: tuple[int, ...]


@dataclass(frozen=True)
class ItopFiles:
    """The depth images of one view and part, and their labels.

    Attributes:
        images: File with ``data`` and ``id``.
        labels: File with ``real_world_coordinates``, ``is_valid`` and ``segmentation``.
    """

    images: Path
    labels: Path

    def runs(self, *, valid_only: bool, gap: int) -> list[Run]:
        """Returns all or all valid frames, as runs with number increments of at most ``gap``.

        Raises:
            DataError: If an array is missing, or an identifier is invalid.
        """
        with hdf5.opened(self.images) as file:
            identifiers = hdf5.read(hdf5.stored(file, "id"))
        with hdf5.opened(self.labels) as file:
            valid = np.asarray(hdf5.read(hdf5.stored(file, "is_valid"))).astype(bool).ravel()
        if len(valid) != len(identifiers):
            raise DataError(
                f"is_valid has {len(valid)} entries, but {self.images.name} holds "
                f"{len(identifiers)} frames",
                place=str(self.labels),
            )
        runs: list[list[tuple[str, int, int]]] = []
        for index, identifier in enumerate(identifiers):
            person, number = self._parsed(identifier, index)
            if valid_only and not valid[index]:
                continue
            before = runs[-1][-1] if runs else None
            if before is None or before[0] != person or not 0 < number - before[1] <= gap:
                runs.append([])
            runs[-1].append((person, number, index))
        if not runs:
            raise DataError("no frame is marked valid (is_valid)", place=str(self.labels))
        return [Run(run[0][0], run[0][1], tuple(index for *_, index in run)) for run in runs]

    def _parsed(self, identifier: Any, index: int) -> tuple[str, int]:
        text = (
            identifier.decode("ascii", "replace") if isinstance(identifier, bytes) else identifier
        )
        match = re.fullmatch(r"(\d+)_(\d+)", str(text))
        if match is None:
            raise DataError(
                f"id[{index}] is '{text}'; it must consist of person and frame, as in 02_00143",
                place=str(self.images),
            )
        return match[1], int(match[2])


@dataclass(frozen=True)
class ItopRecording(Recording):
    """One run of frames.

    Attributes:
        files: The files.
        indices: Indices of the frames in the files.
        segmented: Whether to use only the pixels of the person.
        mirrored: Whether to flip images and joints.
        camera: Camera of the images.
    """

    files: ItopFiles
    indices: tuple[int, ...]
    segmented: bool
    mirrored: bool
    camera: Camera

    def frames(self) -> Iterator[Frame]:
        """Yields the back-projected depth images, read one by one."""
        camera = self.camera
        if self.mirrored:
            camera = replace(camera, cx=camera.width - 1.0 - camera.cx)
        with hdf5.opened(self.files.images) as images, hdf5.opened(self.files.labels) as labels:
            depths = hdf5.stored(images, "data")
            parts = hdf5.stored(labels, "segmentation") if self.segmented else None
            for index in self.indices[: self.length]:
                depth = self._image(depths, index)
                depth = np.where(np.isfinite(depth), depth, 0.0)
                if parts is not None:
                    depth = np.where(self._image(parts, index) >= 0.0, depth, 0.0)
                if self.mirrored:
                    depth = depth[:, ::-1]
                place = f"{self.files.images}: data[{index}]"
                yield Frame(camera.back_projected(depth, place=place), camera, depth, place)

    def input_files(self) -> list[Path]:
        """Returns both files, which all recordings share."""
        return [self.files.images, self.files.labels]

    def truth(self) -> Truth | None:
        """Returns the joints of the valid frames; the others are NaN."""
        indices = list(self.indices[: self.length])
        with hdf5.opened(self.files.labels) as labels:
            stored = hdf5.stored(labels, "real_world_coordinates")
            if stored.shape[1:] != (len(JOINTS), 3):
                raise DataError(
                    f"real_world_coordinates has the shape {stored.shape}; it must be "
                    f"(N, {len(JOINTS)}, 3)",
                    place=str(self.files.labels),
                )
            # HDF5 requires ascending indices, as those of a run are.
            joints = np.asarray(hdf5.read(stored, indices), dtype=np.float64)
            valid = np.asarray(hdf5.read(hdf5.stored(labels, "is_valid"), indices)).astype(bool)
        joints = joints * np.array([-1.0 if self.mirrored else 1.0, -1.0, 1.0])
        joints[~valid.ravel()] = np.nan
        return Truth(JOINTS, joints)

    def _image(self, stored: Any, index: int) -> Array:
        image = np.asarray(hdf5.read(stored, index), dtype=np.float64)
        wanted = (self.camera.height, self.camera.width)
        if image.shape != wanted:
            raise DataError(
                f"{stored.name.lstrip('/')}[{index}] has the shape {image.shape}; it must be "
                f"{wanted}",
                place=stored.file.filename,
            )
        return image
