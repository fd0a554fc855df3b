"""Depth images in folders."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from regkit.config.model import InputPath
from regkit.interfaces import Dataset, Recording
from regkit.recording import CamerasFolder, DepthFolder, cameras
from regkit.recording.search import recordings_in
from regkit_plugins.datasets.formats.cameras_recording import CamerasRecording
from regkit_plugins.datasets.formats.folder_recording import FolderRecording


class DepthFolders(Dataset):
    """A folder of 16-bit PNG depth images with its camera, or a folder of such folders.

    A folder with a ``cameras.json`` is a recording of several cameras, with a folder of depth
    images or clouds each.
    """

    kind: Literal["depth"] = "depth"

    root: InputPath
    """Folder of a recording, or of several recordings."""

    def found(self) -> list[Recording]:
        """Returns a recording for each folder that contains ``depth/`` or ``cameras.json``."""
        return recordings_in(
            self.root, DepthFolder.content, self._recording, self.wanted, several=True
        )

    def _recording(self, folder: Path) -> Recording:
        if (folder / cameras.FILE).is_file():
            return CamerasRecording.of(CamerasFolder.read(folder, self.frames))
        return FolderRecording.of(DepthFolder.read(folder, self.frames))
