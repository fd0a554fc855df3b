"""Point clouds in folders."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from regkit.config.model import InputPath
from regkit.interfaces import Dataset, Recording
from regkit.recording import CloudFolder
from regkit.recording.search import recordings_in
from regkit_plugins.datasets.formats.folder_recording import FolderRecording


class CloudFolders(Dataset):
    """A folder of point clouds, or a folder of such folders.

    A ``.npz`` file holds the array ``points`` (N, 3) [m]. Points that are NaN or infinite are
    missing measurements; a cloud may consist of them. An organised cloud of a pinhole camera is
    its depth image.
    """

    kind: Literal["clouds"] = "clouds"

    root: InputPath
    """Folder of a recording, or of several recordings."""

    def found(self) -> list[Recording]:
        """Returns a recording for each folder that contains ``clouds/``."""
        return recordings_in(self.root, CloudFolder.content, self._recording, self.wanted)

    def _recording(self, folder: Path) -> Recording:
        return FolderRecording.of(CloudFolder.read(folder, self.frames))
