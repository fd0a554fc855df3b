"""The checksums of a finished track, written last: their presence marks it as finished."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Self

from pydantic import TypeAdapter

from regkit.system.digests import file_digest
from regkit.system.errors import DataError
from regkit.system.guard import reading
from regkit.system.json_files import write_json

FILE = "checksums.json"
OVERLAY = "overlay.png"
"""The picture, which can be drawn again from the other files."""
SCENE = "scene.npz"
"""What a replay shows, which tracks of earlier versions lack."""
FILES = ("measure.json", "poses.npz", "record.npz", SCENE, OVERLAY)
"""The files of a finished track."""


@dataclass(frozen=True)
class Manifest:
    """What a track was made from, and the checksums of its files.

    Attributes:
        inputs: Digest of the recording's content.
        files: SHA-256 of each file, by name.
    """

    inputs: str
    files: dict[str, str]

    @classmethod
    def of(cls, folder: Path, inputs: str) -> Self:
        """Returns the manifest of the files in a track's folder.

        Raises:
            DataError: If one is missing.
        """
        sums = {}
        for name in FILES:
            if name == SCENE and not (folder / name).exists():
                continue
            with reading(folder / name, "a file of a track"):
                sums[name] = file_digest(folder / name)
        return cls(inputs, sums)

    @classmethod
    def read(cls, folder: Path) -> Self | None:
        """Returns the manifest in a track's folder; None if the track is not finished.

        Raises:
            DataError: If it is damaged.
        """
        file = folder / FILE
        if not file.exists():
            return None
        with reading(file, "a list of checksums"):
            manifest: Self = TypeAdapter(cls).validate_json(file.read_bytes())
            if {*manifest.files, SCENE} != {*FILES}:
                raise DataError(f"damaged: it must list {', '.join(FILES)}")
            return manifest

    def write(self, folder: Path) -> None:
        """Writes the manifest, by which the track is finished."""
        write_json(folder / FILE, asdict(self))

    def damaged(self, folder: Path) -> list[Path]:
        """Returns the files that are missing, or not those that were written."""
        return [folder / name for name in self.files if not self._intact(folder / name)]

    def check(self, folder: Path) -> None:
        """Checks the files but for the picture.

        Raises:
            DataError: At the first file that is damaged.
        """
        for file in self.damaged(folder):
            if file.name != OVERLAY:
                raise DataError(
                    "damaged: it is missing, or not the file that the run wrote; continue the run, "
                    "which tracks the recording again",
                    place=str(file),
                )

    def _intact(self, file: Path) -> bool:
        try:
            return file_digest(file) == self.files[file.name]
        except OSError:
            return False
