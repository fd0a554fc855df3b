"""The results folder: files of a run, and detection of finished work."""

from __future__ import annotations

import json
import traceback
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np

from regkit.body import Body
from regkit.config.document import Document
from regkit.config.yaml import yaml_data, yaml_text
from regkit.config.yaml_source import yaml_source
from regkit.experiment.differences import differences
from regkit.experiment.environment import environment
from regkit.experiment.lock import MARK
from regkit.experiment.results_format import check_format
from regkit.metrics import Measure
from regkit.report import Record, draw_overlay, method_styles
from regkit.system.errors import ConfigError, DataError, PluginError, RegkitError
from regkit.system.files import remove_unfinished, write_arrays, write_json, write_text
from regkit.system.links import check_links
from regkit.tracking import Track


@dataclass(frozen=True)
class Results:
    """An experiment's results folder.

    config.yaml               the experiment with all defaults filled in
    environment.json          versions, machine and workers
    starts/RECORDING.json      initial pose of every method
    metrics.json              metrics by method and recording, and their summary
    report.html, report.md    the same as tables, figures and images
    figures/, tables/         the figures, and all numbers as CSV
    METHOD/RECORDING/          measure.json, poses.npz, record.npz and overlay.png of a finished
    track

    Attributes:
        folder: Its path.
    """

    folder: Path

    @classmethod
    def opened(cls, folder: Path, config: dict[str, Any], workers: str) -> Results:
        """Returns the folder of an experiment, new or with unfinished results.

        Args:
            folder: Its path, locked by the run.
            config: The experiment as JSON.
            workers: Description of the current workers.

        Raises:
            ConfigError: If it holds the results of another configuration.
            DataError: If it holds results of another format.
        """
        text = yaml_text(config)
        file = folder / "config.yaml"
        check_links(folder)
        if file.exists():
            check_format(folder)
            _check_same(file, text)
        elif any(path.name != MARK for path in folder.iterdir()):
            raise ConfigError(
                "the folder holds other files; choose a new or an empty one",
                place=str(folder),
            )
        for place in (folder, folder / "figures", folder / "tables"):
            remove_unfinished(place)
        write_text(file, text)
        write_json(folder / "environment.json", environment(folder / "environment.json", workers))
        return cls(folder)

    def recording_folder(self, method: str, recording: str) -> Path:
        """Returns the folder of a method's results on a recording."""
        return self.folder / method / recording

    def finished(self, method: str, recording: str) -> Measure | None:
        """Returns the metrics of a finished track, or None.

        Raises:
            DataError: If the file is damaged.
        """
        file = self.recording_folder(method, recording) / "measure.json"
        if not file.exists():
            return None
        try:
            return Measure(**json.loads(file.read_text(encoding="utf-8")))
        except (ValueError, TypeError) as error:
            raise DataError(
                f"damaged ({error}); delete the file to track the recording again",
                place=str(file),
            ) from None

    def failures(self) -> dict[str, dict[str, str]]:
        """Returns reasons of earlier failures by method and recording, from ``metrics.json``."""
        with suppress(OSError, ValueError, KeyError, TypeError, AttributeError):
            metrics = json.loads((self.folder / "metrics.json").read_text(encoding="utf-8"))
            return {
                method: {
                    recording: str(figures["error"])
                    for recording, figures in one["recordings"].items()
                    if "error" in figures
                }
                for method, one in metrics["methods"].items()
            }
        return {}

    def record(self, method: str, recording: str) -> Record | None:
        """Returns the record of a finished track for the report, or None.

        Raises:
            DataError: If the file is damaged.
        """
        file = self.recording_folder(method, recording) / "record.npz"
        if not file.exists():
            return None
        try:
            with file.open("rb") as stream, np.load(stream, allow_pickle=False) as arrays:
                return Record.from_arrays(dict(arrays))
        except (ValueError, KeyError, EOFError, OSError, BadZipFile) as error:
            raise DataError(
                f"damaged ({error}); delete measure.json beside it to track the recording again",
                place=str(file),
            ) from None

    def write(
        self,
        method: str,
        recording: str,
        track: Track,
        body: Body,
        measure: Measure,
        record: Record,
    ) -> None:
        """Writes a finished track; its metrics come last and mark it as finished."""
        folder = self.recording_folder(method, recording)
        write_arrays(folder / "poses.npz", track.named_arrays(body))
        write_arrays(folder / "record.npz", record.arrays())
        config = Document.read(self.folder / "config.yaml").data
        colour = method_styles(config, [method])[method].colour
        draw_overlay(folder / "overlay.png", f"{method} on {recording}", record, colour)
        (folder / "error.txt").unlink(missing_ok=True)
        write_json(folder / "measure.json", measure.to_dict())

    def failed(self, file: Path, error: Exception) -> RegkitError:
        """Returns the error as a RegkitError; the traceback of a programming error is written."""
        if isinstance(error, RegkitError):
            return error
        write_text(file, "".join(traceback.format_exception(error)))
        return PluginError(
            f"{type(error).__name__}: {error}; this is a bug in regkit or in a plug-in, see the "
            f"traceback in {file}"
        )


def _check_same(file: Path, text: str) -> None:
    """Refuses to continue results of another configuration than ``config.yaml``."""
    before = yaml_source(file)
    if before == text:
        return
    there, here = yaml_data(before, str(file)), yaml_data(text, str(file))
    # Comments and the order of fields do not matter.
    if there != here:
        raise ConfigError(
            f"the folder holds the results of another configuration ({file.name}): "
            f"{differences(there, here)}; choose another folder, or run the original one",
            place=str(file.parent),
        )
