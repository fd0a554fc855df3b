"""Recording of a stream while it is tracked."""

from __future__ import annotations

from pathlib import Path
from threading import Lock

from regkit.cli.console import errors
from regkit.interfaces import Stream, TimedFrame
from regkit.recording import FolderWriter
from regkit.recording.writer import check_new
from regkit.system.closing import Closing
from regkit.system.errors import DataError
from regkit.system.notes import note


class RecordingTap(Closing):
    """Writes all frames of a stream into a folder; where that is not possible, tracking goes on.

    Args:
        folder: A new folder.

    Raises:
        ConfigError: If the folder has content, or is a file.
    """

    def __init__(self, folder: Path) -> None:
        check_new(folder)
        self._folder = folder
        self._writer: FolderWriter | None = None
        self._lock = Lock()
        self._over = False

    def begin(self, stream: Stream) -> None:
        """Begins the recording of an opened stream; frames before are not recorded."""
        name = self._folder.absolute().name
        self._writer = FolderWriter(
            self._folder, name, stream.fps, stream.depth_scale, source=stream.name
        )

    def __call__(self, frame: TimedFrame) -> None:
        """Writes a frame."""
        with self._lock:
            if self._writer is None or self._over:
                return
            try:
                self._writer.add(frame)
            except DataError as error:
                self._over = True
                note(f"the recording ends here, the tracking goes on: {error}", place=self._folder)

    def close(self) -> None:
        """Ends the recording."""
        with self._lock:
            self._over = True
            writer, self._writer = self._writer, None
            if writer is not None:
                writer.close()
                count = writer.count
                where = f"in {self._folder}" if count else f"so that there is no {self._folder}"
                errors.print(f"recorded: {count} frames, {where}")
