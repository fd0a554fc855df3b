"""Opening of a results folder: new, or with unfinished results of the same experiment."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from regkit.config.parts import placed_parts
from regkit.config.yaml import yaml_data, yaml_text
from regkit.experiment.differences import differences, different
from regkit.experiment.environment import environment
from regkit.experiment.experiment import Experiment
from regkit.experiment.lock import MARK
from regkit.experiment.provenance import setup as setups
from regkit.experiment.provenance.setup import Setup
from regkit.experiment.results_format import check_format
from regkit.system.errors import ConfigError
from regkit.system.files import remove_unfinished, write_text
from regkit.system.guard import reading
from regkit.system.json_files import write_json
from regkit.system.links import check_links


@dataclass(frozen=True)
class Opening:
    """A results folder to open; ``check`` comes before anything is written.

    Attributes:
        folder: Its path, locked by the run.
        config: The experiment as JSON.
        experiment: The experiment; for a sweep the first one.
        setup: Its setup; None for the folder of a whole sweep, which holds no track.
    """

    folder: Path
    config: dict[str, Any]
    experiment: Experiment
    setup: Setup | None

    def check(self) -> str:
        """Checks that the folder is empty, or holds results of this experiment and setup.

        Returns:
            The paths in the configuration that differ, in a few words; empty if none does. Files
            may have moved, which is no change if their content is the same.

        Raises:
            ConfigError: If it holds results of another configuration or setup, or other files.
            DataError: If it holds results of another format, or is damaged.
        """
        file, folder = self.folder / "config.yaml", self.folder
        if not folder.is_dir():
            return ""
        check_links(folder)
        temporary = (MARK, *(path.name for path in folder.glob(".*.tmp*")))
        others = {path.name for path in folder.iterdir() if path.name not in temporary}
        known = {file.name, setups.FILE} if "environment.json" not in others else others
        # A run that was killed while it opened the folder left these two at most.
        if others and (file.name not in others or others - known):
            raise ConfigError(
                "the folder holds other files; choose a new or an empty one", place=str(folder)
            )
        if not others:
            return ""
        check_format(folder)
        moved = self._moved(file)
        if self.setup is not None and self._begun():
            self.setup.check(folder)
        return moved

    def write(self, workers: str) -> None:
        """Writes configuration, setup and environment, and removes what a kill left.

        Args:
            workers: Description of the current workers.

        Raises:
            DataError: If the folder cannot be written.
        """
        self.folder.mkdir(exist_ok=True)
        for place in (self.folder, self.folder / "figures", self.folder / "tables"):
            remove_unfinished(place)
        write_text(self.folder / "config.yaml", yaml_text(self.config))
        if self.setup is not None:
            self.setup.write(self.folder)
        file = self.folder / "environment.json"
        write_json(file, environment(file, workers))

    def _begun(self) -> bool:
        """Whether the folder holds anything that was computed."""
        return any(
            next(self.folder.glob(pattern), None) is not None
            for pattern in ("starts/*.json", "*/*/checksums.json")
        )

    def _moved(self, file: Path) -> str:
        """Refuses to continue results of another configuration than ``config.yaml``."""
        with reading(file, "a configuration"):
            there = yaml_data(file.read_text(encoding="utf-8"), str(file))
        here = yaml_data(yaml_text(self.config), "")
        # Comments and the order of fields do not matter.
        fields = set(different(there, here))
        told = differences(there, here)
        if not fields <= set(_paths(self.experiment)):
            raise another_configuration(told, self.folder)
        return told


def another_configuration(told: str, folder: Path) -> ConfigError:
    """Returns the error of a folder with the results of another configuration."""
    return ConfigError(
        f"the folder holds the results of another configuration (config.yaml): {told}; choose "
        "another folder, or run the original one",
        place=str(folder),
    )


def _paths(value: Any, place: str = "") -> Iterator[str]:
    """Yields the fields of a configuration that hold paths."""
    if isinstance(value, Path):
        yield place
    for inner, part in placed_parts(value, place):
        yield from _paths(part, inner)
