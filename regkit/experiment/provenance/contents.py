"""Which tracks in a results folder belong to the same content of their recordings."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

from regkit.experiment.provenance.manifest import Manifest
from regkit.experiment.provenance.recording import RecordingInputs, inputs_file
from regkit.system.notes import note


@dataclass(frozen=True)
class Contents:
    """The latest content of each recording, as the run wrote it; the data are not needed.

    Attributes:
        folder: The results folder, of an experiment or of a sweep.
    """

    folder: Path
    _known: dict[Path, str] = field(default_factory=dict)

    def current(self, method: str, recording: str) -> bool:
        """Whether a track was made from the recording's latest content; others are told.

        Args:
            method: Name of the method; of a sweep, ``SETTING/METHOD``.
            recording: Name of the recording.

        Raises:
            DataError: If the content is missing or damaged.
        """
        manifest = Manifest.read(self.folder / method / recording)
        latest = self._latest(self.folder / PurePosixPath(method).parent, recording)
        if manifest is None or manifest.inputs == latest:
            return manifest is not None
        note(
            f"{method} tracked {recording} before its data changed; it is left out until the run "
            "is continued",
            place=self.folder,
        )
        return False

    def _latest(self, folder: Path, recording: str) -> str:
        file = inputs_file(folder, recording)
        if file not in self._known:
            self._known[file] = RecordingInputs.read(file).digest
        return self._known[file]
