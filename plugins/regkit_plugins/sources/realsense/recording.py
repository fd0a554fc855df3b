"""Recordings of RealSense cameras."""

from __future__ import annotations

import time
from contextlib import suppress
from pathlib import Path
from typing import Any, ClassVar, Literal

from regkit.config.model import InputPath
from regkit.interfaces import Source, Stream, TimedFrame
from regkit.system.errors import DataError, SourceLostError
from regkit.system.guard import reading
from regkit_plugins.sources.formats.realsense_topics import is_realsense
from regkit_plugins.sources.realsense.library import realsense
from regkit_plugins.sources.realsense.profiles import depth_profiles
from regkit_plugins.sources.realsense.stream import DeviceStream

BEHIND = 8
"""Number of frames that are read ahead."""

PATIENCE = 10.0
"""Time [s] without a frame after which a recording that has not ended counts as damaged."""


class RealSenseRecording(Source):
    """A file that RealSense's viewer or library recorded, ``.db3`` or ``.bag``.

    Every frame is read, in its own time. Times are those of the camera.
    """

    kind: Literal["realsense_recording"] = "realsense_recording"

    suffixes: ClassVar[tuple[str, ...]] = (".bag", ".db3")

    path: InputPath
    """The file."""

    @classmethod
    def accepts(cls, path: Path) -> bool:
        """Returns whether it is the recording of a RealSense camera, and no bag of ROS."""
        return super().accepts(path) and is_realsense(path)

    def open(self) -> Stream:
        """Opens the recording at its first frame.

        Raises:
            DataError: If it is missing or damaged, or has no depth images.
            DependencyError: If pyrealsense2 is not installed.
        """
        library = realsense()
        if not self.path.is_file():
            raise DataError("there is no such file", place=str(self.path))
        with reading(self.path, "a recording of a RealSense camera"):
            player = library.context().load_device(str(self.path)).as_playback()
            player.set_real_time(False)
            found = depth_profiles(player)
        if not found:
            raise DataError("the recording has no depth images", place=str(self.path))
        return PlaybackStream(player, *found[0], self.path)


class PlaybackStream(DeviceStream):
    """The depth images of a recording."""

    def __init__(self, player: Any, sensor: Any, profile: Any, path: Path) -> None:
        """Starts to play.

        Raises:
            DataError: If its images cannot be used.
        """
        self.name = path.stem
        self._ended = False
        super().__init__(player, sensor, profile, place=str(path), behind=BEHIND)

    def close(self) -> None:
        """Ends the playback."""
        if self._open:
            # A recording that is released while it is read ends the process.
            with suppress(RuntimeError):
                self._device.pause()
        super().close()

    def read(self) -> TimedFrame | None:
        """Returns the next frame; None at the end.

        Raises:
            DataError: If the frame is damaged.
            SourceLostError: If the file ends before the recording does.
        """
        end = time.monotonic() + PATIENCE
        while self._open and not self._ended:
            stopped = self._device.current_status() == realsense().playback_status.stopped
            frame = self._wait()
            if frame is not None:
                return self._timed(frame)
            self._ended = stopped
            if not stopped and time.monotonic() > end:
                raise SourceLostError(
                    "the file yields no further frame, although it has not ended",
                    place=self._place,
                )
        return None
