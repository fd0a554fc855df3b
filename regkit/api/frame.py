"""One frame from an array of a program: a depth image or a cloud, validated."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from regkit.api.numbers import checked_numbers
from regkit.geometry.camera import Camera
from regkit.geometry.intrinsics import intrinsics_of
from regkit.geometry.lens import Lens
from regkit.observation import Frame
from regkit.system.arrays import measured_points
from regkit.system.errors import ConfigError, DataError
from regkit.system.notes import note

Measured = Frame | ArrayLike
"""A depth image (H, W) [m], a cloud (N, 3) [m], or a frame."""

Intrinsics = Camera | str | Path | ArrayLike
"""A camera, its ``camera.json``, or its matrix K (3, 3) [px]."""


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
    lens = None if camera is None else _lens(camera, values.shape)
    seen = None if lens is None else lens.camera
    if values.shape[1] == 3 and (seen is None or (seen.height, seen.width) != values.shape):
        points = measured_points(values, place=place)
        if tell:
            tell_missing(len(values) - len(points), place)
        return Frame(points, seen, place=place)
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
        return Frame.of_image(values, lens, place=place)
    except DataError as error:
        raise error.at(place) from None


def tell_missing(count: int, place: str) -> None:
    """Tells how many points are missing measurements, if any is."""
    if count:
        note(
            f"{count} points are missing measurements (NaN or infinite) and are dropped",
            place=place,
        )


def _lens(camera: Intrinsics, shape: tuple[int, ...]) -> Lens:
    """Returns the camera of an image of shape (H, W), with the distortion in its file."""
    if isinstance(camera, Camera):
        return Lens(camera)
    if isinstance(camera, (str, Path)):
        return Lens.read(Path(camera))
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
        return Lens(Camera(width, height, *intrinsics_of(matrix)))
    except DataError as error:
        raise error.at("camera") from None
