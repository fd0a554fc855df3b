"""The results folder: what is written, and what a resumed run finds there."""

from __future__ import annotations

import json
import traceback
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from regkit.body import Body
from regkit.document import yaml_text
from regkit.errors import ConfigError, DataError, PluginError, RegkitError
from regkit.experiment.environment import environment
from regkit.experiment.experiment import Experiment
from regkit.files import write_arrays, write_json, write_text
from regkit.metrics import Measure, mean_of
from regkit.tracking import Track


@dataclass(frozen=True)
class Results:
    """An experiment's folder.

    config.yaml               the experiment with every default filled in
    environment.json          versions and machine
    metrics.json              figures by method and sequence, and their means
    report.md                 the same as tables, and pictures
    METHOD/SEQUENCE/          measure.json, poses.npz and overlay.png of a finished sequence

    Attributes:
        folder: Where it is.
    """

    folder: Path

    @classmethod
    def opened(cls, folder: Path, experiment: Experiment) -> Results:
        """The folder for an experiment, new or begun before with the same configuration.

        Raises:
            ConfigError: If it holds the results of another configuration.
        """
        results = cls(folder)
        config = yaml_text(experiment.model_dump(mode="json"))
        file = folder / "config.yaml"
        if folder.exists() and not folder.is_dir():
            raise ConfigError("this is a file, not a folder", place=f"--out {folder}")
        if file.exists() and file.read_text(encoding="utf-8") != config:
            raise ConfigError(
                f"the folder holds the results of another configuration ({file}); "
                "choose another folder, or run what it was begun with",
                place=f"--out {folder}",
            )
        if not file.exists() and folder.exists() and any(folder.iterdir()):
            raise ConfigError(
                "the folder holds other files; choose a new or an empty one",
                place=f"--out {folder}",
            )
        write_text(file, config)
        write_json(folder / "environment.json", environment())
        return results

    def sequence_folder(self, method: str, sequence: str) -> Path:
        """Where a method's results on a sequence are."""
        return self.folder / method / sequence

    def finished(self, method: str, sequence: str) -> Measure | None:
        """The figures of a sequence that was finished before, or None.

        Raises:
            DataError: If the file was damaged since.
        """
        file = self.sequence_folder(method, sequence) / "measure.json"
        if not file.exists():
            return None
        try:
            return Measure(**json.loads(file.read_text(encoding="utf-8")))
        except (ValueError, TypeError) as error:
            raise DataError(
                f"damaged ({error}); delete the file to have the sequence done again",
                place=str(file),
            ) from None

    def write(self, method: str, sequence: str, track: Track, body: Body, measure: Measure) -> None:
        """Write a finished sequence; its figures come last, and with them it counts as finished."""
        folder = self.sequence_folder(method, sequence)
        write_arrays(folder / "poses.npz", track.named_arrays(body))
        (folder / "error.txt").unlink(missing_ok=True)
        write_json(folder / "measure.json", measure.to_dict())

    def failed(self, method: str, sequence: str, error: Exception) -> RegkitError:
        """The error as one that can be told; of a programming error the traceback is kept."""
        if isinstance(error, RegkitError):
            return error
        file = self.sequence_folder(method, sequence) / "error.txt"
        write_text(file, "".join(traceback.format_exception(error)))
        return PluginError(
            f"{type(error).__name__}: {error}; this is a fault of the program or of a plug-in, and "
            f"{file} says where"
        )

    def write_report(self, text: str) -> None:
        """Write ``report.md``."""
        write_text(self.folder / "report.md", text)

    def write_metrics(
        self, measures: dict[str, dict[str, Measure]], failures: dict[str, dict[str, str]]
    ) -> None:
        """Write ``metrics.json``; a failed sequence has all its figures null, and says why."""
        methods = {}
        for method, by_sequence in measures.items():
            sequences: dict[str, Any] = {
                sequence: measure.to_dict() for sequence, measure in by_sequence.items()
            }
            for sequence, reason in failures.get(method, {}).items():
                sequences[sequence] = mean_of([]).to_dict() | {"error": reason}
            mean = mean_of(list(by_sequence.values()))
            methods[method] = {"sequences": sequences, "mean": mean.to_dict()}
        write_json(self.folder / "metrics.json", {"methods": methods})
