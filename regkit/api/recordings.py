"""Recordings from arrays of a program, or from a folder."""

from __future__ import annotations

from collections.abc import Iterable
from collections.abc import Sequence as Many
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from regkit.api.frame import Intrinsics, Measured, frame_of, tell_missing
from regkit.interfaces import Dataset, Recording
from regkit.system.errors import ConfigError, DataError
from regkit.tracking.given_frames import GivenFrames

Frames = Recording | Dataset | str | Path | Many[Measured] | ArrayLike
"""Depth images (T, H, W) [m], a list of images or clouds, a folder, a dataset or a recording."""


def load_recording(folder: str | Path, *, frames: int | None = None) -> Recording:
    """Returns a recording: that of a folder, or of a file that a source reads.

    ``frames()`` yields its frames, ``truth()`` returns its reference joints or None.

    Args:
        folder: The recording's folder, ``depth/`` or ``clouds/`` beside a ``sequence.yaml``; or a
            bag of ROS, or the file of a camera.
        frames: Maximum number of frames, from the first; all by default.

    Raises:
        RegkitError: If it holds no recording, or several, or is damaged.
    """
    data = Dataset.at(folder, frames=frames)
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
    tell_missing(lost, "frames")
    return GivenFrames(name="frames", fps=fps, length=len(given), given=tuple(given))
