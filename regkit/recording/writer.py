"""Writing of a recording's folder, frame by frame."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import TextIO

import numpy as np
from numpy.typing import NDArray

from regkit.observation import Camera, TimedFrame
from regkit.recording import description, times
from regkit.recording.depth_folder import DepthFolder
from regkit.recording.png import png_of
from regkit.system.arrays import Array
from regkit.system.closing import Closing
from regkit.system.errors import ConfigError, DataError
from regkit.system.files import replacing, write_text
from regkit.system.notes import note
from regkit.system.printable import one_line

Image = NDArray[np.uint16]
"""Pixels (H, W) in units of the recording."""

LARGEST = 65535
"""Largest value of a pixel of 16 bits."""


class FolderWriter(Closing):
    """Writes depth images with their times as the folder of a recording.

    From the first frame on, what is in the folder is a whole recording at any time, also if the
    process is killed: each image is renamed into place, after its time is written. Nothing is
    written before the first frame.
    """

    def __init__(
        self, folder: Path, name: str, fps: float, depth_scale: float, *, source: str = ""
    ) -> None:
        """Prepares the recording.

        Args:
            folder: A new or empty folder.
            name: Name of the recording.
            fps: Frames per second [1/s].
            depth_scale: Image units per metre.
            source: Origin of the frames.

        Raises:
            ConfigError: If the folder has content, or the path is a file.
        """
        check_new(folder)
        self.folder = folder
        self.count = 0
        """Number of frames that were written."""
        self._header = {
            "name": re.sub(r"[^\w. -]|^[. -]", "_", name) or "recording",
            "fps": fps,
            "depth_scale": depth_scale,
            "source": one_line(source),
        }
        self._scale = depth_scale
        self._camera: Camera | None = None
        self._times: TextIO | None = None
        self._told = False

    def add(self, timed: TimedFrame) -> None:
        """Writes the next frame.

        Args:
            timed: A frame with a depth image.

        Raises:
            DataError: If it has no depth image, another camera than the frames
                before it; or if the folder cannot be written.
        """
        frame = timed.frame
        if frame.views:
            raise DataError(
                "the frame is that of several cameras; record each camera by itself",
                place=frame.place,
            )
        if frame.depth is None or frame.camera is None:
            raise DataError(
                "the frame is a cloud without a depth image; only depth images are recorded",
                place=frame.place,
            )
        if self._camera is not None and frame.camera != self._camera:
            raise DataError(
                f"the camera changed from {_described(self._camera)} to "
                f"{_described(frame.camera)}; a recording has one camera",
                place=frame.place,
            )
        image = self._image(frame.depth, frame.place)
        try:
            self._write(image, frame.camera, timed.time)
        except OSError as error:
            raise DataError(
                f"cannot be written: {error.strerror or error}", place=str(self.folder)
            ) from None
        self._camera = frame.camera
        self.count += 1

    def close(self) -> None:
        """Ends the recording; calling it again does nothing."""
        if self._times is not None:
            self._times.close()
            self._times = None

    def _write(self, image: Image, camera: Camera, time: float) -> None:
        """Writes the next frame, whole or not at all."""
        if self._times is None:
            self._times = self._begin(camera)
        # An image without a time would not be readable; a time without an image is not read.
        before = self._times.tell()
        self._times.write(f"{self.count},{time!r}\n")
        self._times.flush()
        try:
            path = self.folder / DepthFolder.content / f"{self.count:06d}.png"
            with replacing(path) as temporary:
                temporary.write_bytes(png_of(image))
        except BaseException:
            # The next frame takes this number, at another time.
            self._times.seek(before)
            self._times.truncate()
            raise

    def _begin(self, camera: Camera) -> TextIO:
        """Writes what all frames share, and returns the file of their times."""
        # JSON is YAML, and keeps every number; its escapes of rare characters are not.
        header = "".join(
            f"{name}: {json.dumps(value, ensure_ascii=False)}\n"
            for name, value in self._header.items()
        )
        write_text(self.folder / description.FILE, header)
        write_text(self.folder / "camera.json", camera.to_json())
        file = (self.folder / times.FILE).open("w", encoding="utf-8", newline="\n")
        file.write(f"{times.HEADER}\n")
        return file

    def _image(self, depth: Array, place: str | None) -> Image:
        """Returns the pixels (H, W) of 16 bits of a depth image [m]."""
        values = np.rint(np.where(depth > 0.0, depth, 0.0) * self._scale)
        far = values > LARGEST
        if far.any() and not self._told:
            self._told = True
            note(
                f"pixels are farther than {LARGEST / self._scale:.4g} m, more than 16 bits hold at "
                f"{self._scale:g} units per metre; they are left out",
                place=place,
            )
        return np.where(far, 0.0, values).astype(np.uint16)


def check_new(folder: Path) -> None:
    """Refuses a folder that has content.

    Raises:
        ConfigError: If it has, or the path is a file.
    """
    if folder.exists() and not folder.is_dir():
        raise ConfigError("this is a file; name a new folder", place=str(folder))
    if folder.is_dir() and any(folder.iterdir()):
        raise ConfigError(
            "the folder exists already, and is not empty; choose another one", place=str(folder)
        )


def _described(camera: Camera) -> str:
    return f"{camera.width}x{camera.height} with f = {camera.fx:.5g} px"
