"""Depth images in folders."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from regkit.config.model import InputPath
from regkit.interfaces import Dataset, Recording
from regkit.recording import DepthFolder
from regkit.recording.search import recordings_in
from regkit_plugins.datasets.formats.folder_recording import FolderRecording


class DepthFolders(Dataset):
    """A folder of 16-bit PNG depth images with its camera, or a folder of such folders."""

    kind: Literal["depth"] = "depth"

    root: InputPath
    """Folder of a recording, or of several recordings."""

    def found(self) -> list[Recording]:
        """Returns a recording for each folder that contains ``depth/``."""
        return recordings_in(self.root, DepthFolder.content, self._recording, self.wanted)

    def _recording(self, folder: Path) -> Recording:
        return FolderRecording.of(DepthFolder.read(folder, self.frames))
