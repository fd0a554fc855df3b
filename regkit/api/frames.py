"""Frames from arrays of a program: depth images and clouds, validated."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from collections.abc import Sequence as Many
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from regkit.api.numbers import checked_numbers
from regkit.geometry.camera import Camera
from regkit.geometry.intrinsics import intrinsics_of
from regkit.interfaces import Dataset, Recording
from regkit.observation import Frame
from regkit.system.arrays import measured_points
from regkit.system.errors import ConfigError, DataError
from regkit.system.notes import note

Measured = Frame | ArrayLike
"""A depth image (H, W) [m], a cloud (N, 3) [m], or a frame."""

Frames = Recording | Dataset | str | Path | Many[Measured] | ArrayLike
"""Depth images (T, H, W) [m], a list of images or clouds, a folder, a dataset or a recording."""

Intrinsics = Camera | str | Path | ArrayLike
"""A camera, its ``camera.json``, or its matrix K (3, 3) [px]."""


@dataclass(frozen=True)
class GivenFrames(Recording):
    """A recording of frames in memory.

    Attributes:
        given: The frames.
    """

    given: tuple[Frame, ...]

    def __post_init__(self) -> None:
        """Raises DataError if no frame holds a point."""
        if not any(len(frame.points) for frame in self.given):
            raise DataError(
                "there is no measurement: all depths or points are zero, NaN or infinite",
                place=self.name,
            )

    def frames(self) -> Iterator[Frame]:
        """Yields all frames."""
        yield from self.given

    def some(self, indices: Iterable[int]) -> Iterator[tuple[int, Frame]]:
        """Yields the frames of ``indices`` with their numbers, in ascending order."""
        for index in sorted(set(indices)):
            yield index, self.given[index]

    def truth(self) -> None:
        """Returns None: arrays have no reference joints."""


def load_recording(folder: str | Path, *, frames: int | None = None) -> Recording:
    """Returns the recording of a folder: ``depth/`` or ``clouds/`` beside a ``sequence.yaml``.

    ``frames()`` yields its frames, ``truth()`` returns its reference joints or None.

    Args:
        folder: The recording's folder.
        frames: Maximum number of frames, from the first; all by default.

    Raises:
        RegkitError: If the folder holds no recording, or several, or is damaged.
    """
    data = Dataset.in_folder(folder, frames=frames)
    return Dataset.parse(data, place="load_recording", field="dataset").only()


def recording_of(frames: Frames, camera: Intrinsics | None, fps: float) -> Recording:
    """Returns the given recording, or a recording of the given arrays.

    Args:
        frames: A recording, a dataset, a folder, or arrays.
        camera: Camera of arrays that are depth images.
        fps: Frames per second of arrays.

    Raises:
        RegkitError: If ``frames`` are invalid, or have a camera of their own beside ``camera``.
    """
    if isinstance(frames, (Recording, Dataset, str, Path)):
        if camera is not None:
            raise ConfigError("recordings and folders have a camera of their own", place="camera")
        if isinstance(frames, Recording):
            return frames
        return frames.only() if isinstance(frames, Dataset) else load_recording(frames)
    if isinstance(frames, np.ndarray) and frames.ndim < 3:
        raise DataError(
            f"one array of shape {frames.shape}; several frames are needed: depth images (T, H, W) "
            "or a list of clouds (N, 3). For one frame use regkit.register",
            place="frames",
        )
    if not isinstance(frames, Iterable):
        raise ConfigError(f"{frames!r} is not a sequence of frames", place="frames")
    many = list(frames)
    if not many:
        raise DataError("there are no frames", place="frames")
    if not 0.0 < fps < np.inf:
        raise ConfigError(f"must be a positive number; it is {fps}", place="fps")
    given = [frame_of(one, camera, place=f"frames[{n}]", tell=False) for n, one in enumerate(many)]
    lost = sum(
        len(np.asarray(one)) - len(frame.points)
        for one, frame in zip(many, given, strict=True)
        if frame is not one and frame.depth is None
    )
    _tell_missing(lost, "frames")
    return GivenFrames(name="frames", fps=fps, length=len(given), given=tuple(given))


def frame_of(
    measured: Measured, camera: Intrinsics | None, *, place: str, tell: bool = True
) -> Frame:
    """Returns the frame of a depth image (H, W) [m] or a cloud (N, 3) [m].

    Numbers that are NaN or infinite are missing measurements; the rows of a cloud are dropped, and
    told.

    Args:
        measured: The image, the cloud, or a frame, which is returned unchanged.
        camera: Camera of the image, or the one that saw the cloud.
        place: Name of the array in messages.
        tell: Whether to tell how many points are missing measurements.

    Raises:
        DataError: If the array is neither, or holds invalid measurements.
    """
    if isinstance(measured, Frame):
        return measured
    values = checked_numbers(measured, place=place)
    if values.ndim != 2:
        raise DataError(
            f"an array of shape {values.shape}; a depth image is (H, W), a cloud (N, 3)",
            place=place,
        )
    # A cloud without points is a frame without data; an image without pixels is a mistake.
    if not len(values) and values.shape[1] != 3:
        raise DataError("the array is empty", place=place)
    lens = None if camera is None else _camera(camera, values.shape)
    if values.shape[1] == 3 and (lens is None or (lens.height, lens.width) != values.shape):
        points = measured_points(values, place=place)
        if tell:
            _tell_missing(len(values) - len(points), place)
        return Frame(points, lens, place=place)
    if lens is None:
        raise ConfigError(
            f"{place} of shape {values.shape} is a depth image, which needs a camera: its "
            "camera.json, or its matrix K (3, 3)",
            place="camera",
        )
    values = np.where(np.isfinite(values), values, 0.0)
    if (values < 0.0).any():
        raise DataError(
            f"{int((values < 0.0).sum())} depths are negative, the lowest {values.min():.4g}; mark "
            "pixels without a measurement by 0 or NaN",
            place=place,
        )
    try:
        return Frame(lens.back_projected(values), lens, values, place=place)
    except DataError as error:
        raise error.at(place) from None


def _tell_missing(count: int, place: str) -> None:
    if count:
        note(
            f"{count} points are missing measurements (NaN or infinite) and are dropped",
            place=place,
        )


def _camera(camera: Intrinsics, shape: tuple[int, ...]) -> Camera:
    """Returns the camera of an image of shape (H, W)."""
    if isinstance(camera, Camera):
        return camera
    if isinstance(camera, (str, Path)):
        return Camera.read(Path(camera))
    matrix = checked_numbers(camera, place="camera", whole=True)
    if matrix.shape != (3, 3):
        raise DataError(
            "a camera must be a regkit.Camera, a camera.json, or a matrix K = [[fx, 0, cx], "
            f"[0, fy, cy], [0, 0, 1]]; this is an array of shape {matrix.shape}",
            place="camera",
        )
    height, width = shape
    if width == 3:
        raise ConfigError(
            "a matrix does not contain the image's size; for a cloud give a regkit.Camera",
            place="camera",
        )
    try:
        return Camera(width, height, *intrinsics_of(matrix))
    except DataError as error:
        raise error.at("camera") from None
