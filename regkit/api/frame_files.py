"""One frame from a file."""

from __future__ import annotations

import math
from pathlib import Path

from regkit.api.frame import frame_of
from regkit.api.recordings import load_recording
from regkit.clouds import read_cloud
from regkit.geometry.camera import Camera
from regkit.observation import Frame
from regkit.observation.depth_image import read_depth
from regkit.observation.organised import organised_frame
from regkit.system.errors import ConfigError, DataError

MILLIMETRES = 1000.0
"""Default number of units per metre of a depth image."""


def load_frame(path: str | Path, *, index: int = 0, depth_scale: float = MILLIMETRES) -> Frame:
    """Returns one frame from a file, for ``regkit.register``.

    Args:
        path: The folder of a recording; a 16-bit PNG depth image with its ``camera.json`` beside
            it, or in the ``depth`` folder of a recording; or the file of a cloud or a mesh. With a
            ``camera.json`` beside it, a cloud is treated as the surface visible to that camera. An
            organised cloud, in rows and columns as the pixels of a pinhole camera, is the depth
            image of that camera.
        index: Number of the frame in a recording's folder, from 0.
        depth_scale: Units per metre of a depth image outside a recording.

    Raises:
        RegkitError: If the frame does not exist, or is damaged.
    """
    if not 0.0 < depth_scale < math.inf:
        raise ConfigError(f"must be a positive number; it is {depth_scale}", place="depth_scale")
    file = Path(path)
    if file.is_dir():
        return _of_recording(file, index)
    camera = file.with_name("camera.json")
    if file.suffix.lower() != ".png":
        if camera.is_file():
            return Frame(read_cloud(file), Camera.read(camera), place=str(file))
        return organised_frame(file) or Frame(read_cloud(file), place=str(file))
    if camera.is_file():
        return frame_of(read_depth(file) / depth_scale, camera, place=str(file))
    folder = file.absolute().parent.parent
    if file.is_file() and file.absolute().parent.name == "depth" and folder.is_dir():
        images = sorted(one for one in file.parent.iterdir() if one.suffix.lower() == ".png")
        return _of_recording(folder, images.index(file))
    read_depth(file)
    raise DataError(f"a depth image needs its camera; there is no {camera}", place=str(file))


def _of_recording(folder: Path, index: int) -> Frame:
    recording = load_recording(folder)
    if not 0 <= index < recording.length:
        raise DataError(
            f"there is no frame {index}; the recording has {recording.length}, from 0",
            place=str(folder),
        )
    ((_, frame),) = recording.some([index])
    return frame
