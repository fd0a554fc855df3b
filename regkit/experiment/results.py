"""The results folder: files of tracks, and detection of finished work."""

from __future__ import annotations

import traceback
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from regkit.body import Body
from regkit.config.document import Document
from regkit.experiment.provenance.manifest import FILE, OVERLAY, SCENE, Manifest
from regkit.experiment.summary_file import SummaryFile
from regkit.metrics import Measure, checked_measure
from regkit.report import Record, draw_overlay, method_styles
from regkit.system.archives import read_arrays
from regkit.system.errors import PluginError, RegkitError
from regkit.system.files import write_arrays, write_text
from regkit.system.guard import reading
from regkit.system.json_files import read_json, write_json
from regkit.tracking import Track
from regkit.viewer.track_file import read_scene, write_scene
from regkit.viewer.track_scene import TrackScene


@dataclass(frozen=True)
class Results:
    """An experiment's results folder.

    config.yaml               the experiment with all defaults filled in
    environment.json          versions, machine and workers
    setup.json                versions, code, templates and files that results depend on
    inputs/RECORDING.json      digests of the recording's files
    starts/RECORDING.json      initial pose of every method
    metrics.json              metrics by method and recording, and their summary
    report.html, report.md    the same as tables, figures and images
    replay.html               the tracks and the worst frames, to look at in a browser
    figures/, tables/         the figures, and all numbers as CSV
    METHOD/RECORDING/          measure.json, poses.npz, record.npz, scene.npz and overlay.png of a
    finished track, and checksums.json, which marks it as finished

    Attributes:
        folder: Its path.
    """

    folder: Path

    def recording_folder(self, method: str, recording: str) -> Path:
        """Returns the folder of a method's results on a recording."""
        return self.folder / method / recording

    def begun(self, method: str, recording: str) -> bool:
        """Whether a track has been finished, on the present data or on others."""
        return (self.recording_folder(method, recording) / FILE).exists()

    def finished(self, method: str, recording: str, inputs: str | None = None) -> Measure | None:
        """Returns the metrics of a finished track, or None.

        A picture that is missing or damaged is drawn again.

        Args:
            method: Name of the method.
            recording: Name of the recording.
            inputs: Digest of the recording's content; a track of another content is not finished.

        Raises:
            DataError: If a file is damaged.
        """
        folder = self.recording_folder(method, recording)
        manifest = Manifest.read(folder)
        if manifest is None or inputs not in (None, manifest.inputs):
            return None
        damaged = manifest.damaged(folder)
        manifest.check(folder)
        file = folder / "measure.json"
        measure = checked_measure(read_json(file), place=str(file))
        if damaged:
            self._draw(method, recording, self.record(method, recording))
            Manifest.of(folder, manifest.inputs).write(folder)
        return measure

    def failures(self) -> dict[str, dict[str, str]]:
        """Returns reasons of earlier failures by method and recording, from ``metrics.json``.

        Raises:
            DataError: If the file is damaged.
        """
        return SummaryFile.read(self.folder).failures()

    def record(self, method: str, recording: str) -> Record:
        """Returns the record of a finished track for the report.

        Raises:
            DataError: If the file is damaged.
        """
        file = self.recording_folder(method, recording) / "record.npz"
        what = "a record of regkit run"
        with reading(file, what):
            return Record.from_arrays(read_arrays(file, what=what))

    def scene(self, method: str, recording: str) -> TrackScene | None:
        """Returns the scene of a finished track; None for a track of an earlier version.

        Raises:
            DataError: If the file is damaged.
        """
        folder = self.recording_folder(method, recording)
        return read_scene(folder) if (folder / SCENE).exists() else None

    def write(
        self,
        method: str,
        recording: str,
        inputs: str,
        track: Track,
        body: Body,
        measure: Measure,
        record: Record,
        scene: TrackScene,
    ) -> None:
        """Writes a finished track; its checksums come last and mark it as finished.

        Raises:
            DataError: If a metric is out of its range, or a file cannot be written.
        """
        folder = self.recording_folder(method, recording)
        checked_measure(measure.to_dict(), place=f"{method} on {recording}")
        (folder / FILE).unlink(missing_ok=True)
        write_arrays(folder / "poses.npz", track.named_arrays(body))
        write_arrays(folder / "record.npz", record.arrays())
        write_scene(scene, folder)
        self._draw(method, recording, record)
        (folder / "error.txt").unlink(missing_ok=True)
        write_json(folder / "measure.json", measure.to_dict())
        Manifest.of(folder, inputs).write(folder)

    def _draw(self, method: str, recording: str, record: Record) -> None:
        config: dict[str, Any] = Document.read(self.folder / "config.yaml").data
        colour = method_styles(config, [method])[method].colour
        file = self.recording_folder(method, recording) / OVERLAY
        draw_overlay(file, f"{method} on {recording}", record, colour)

    def failed(self, file: Path, error: Exception) -> RegkitError:
        """Returns the error as a RegkitError; the traceback of a programming error is written."""
        if isinstance(error, RegkitError):
            return error
        write_text(file, "".join(traceback.format_exception(error)))
        return PluginError(
            f"{type(error).__name__}: {error}; this is a bug in regkit or in a plug-in, see the "
            f"traceback in {file}"
        )
