"""One frame from a file."""

from __future__ import annotations

from pathlib import Path

from regkit.api.frames import frame_of, load_recording
from regkit.clouds import read_cloud
from regkit.geometry.camera import Camera
from regkit.observation import Frame
from regkit.observation.depth_image import read_depth
from regkit.system.errors import DataError

MILLIMETRES = 1000.0
"""Units of a depth image in a metre, where nothing says otherwise."""


def load_frame(path: str | Path, *, index: int = 0, depth_scale: float = MILLIMETRES) -> Frame:
    """One frame, as ``regkit.register`` takes it.

    Args:
        path: The folder of a recording; a 16-bit PNG depth image with its ``camera.json`` beside
            it, or in the ``depth`` folder of a recording; or a file of a cloud or a mesh, whose
            points are taken for what a camera sees if a ``camera.json`` lies beside it.
        index: Which frame of a recording's folder, from 0.
        depth_scale: Units per metre of a depth image that is in no recording.

    Raises:
        RegkitError: If there is no such frame, or it is damaged.
    """
    file = Path(path)
    if file.is_dir():
        return _of_recording(file, index)
    camera = file.with_name("camera.json")
    if file.suffix.lower() != ".png":
        seen_by = Camera.read(camera) if camera.is_file() else None
        return Frame(read_cloud(file), seen_by, place=str(file))
    if camera.is_file():
        return frame_of(read_depth(file) / depth_scale, camera, place=str(file))
    folder = file.absolute().parents[1]
    if file.is_file() and file.absolute().parent.name == "depth" and folder.is_dir():
        images = sorted(file.parent.glob("*.png"))
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
