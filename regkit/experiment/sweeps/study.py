"""An experiment's YAML with its sweep: one experiment or many."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from regkit.config.document import Document
from regkit.experiment.experiment import Experiment
from regkit.experiment.resolved import resolved
from regkit.experiment.sweeps.sweep import combinations
from regkit.system.errors import ConfigError

SHOWN = 5
"""Maximum number of listed errors; a sweep repeats the same error many times."""


@dataclass(frozen=True)
class Study:
    """The experiments of a YAML file, by names that are valid as folders.

    Attributes:
        experiments: In the order of the sweep's lists. A single experiment has an empty name; its
            methods may be variants.
        lists: Values of the fields in which the experiments differ, in the same order.
    """

    experiments: dict[str, Experiment]
    lists: dict[str, list[Any]]

    @property
    def name(self) -> str:
        """Name of the results folder."""
        return self._first.name

    @property
    def methods(self) -> list[str]:
        """Names of the methods, which are the same in all experiments."""
        return list(self._first.methods)

    @property
    def _first(self) -> Experiment:
        return next(iter(self.experiments.values()))

    @classmethod
    def of_one(cls, experiment: Experiment) -> Study:
        """Returns a study of a single experiment."""
        return cls({"": experiment}, {})

    @classmethod
    def read(cls, path: Path, settings: Iterable[str] = (), *, called: str = "setting") -> Study:
        """Reads an experiment's YAML, and applies ``a.b.c=value`` settings.

        Args:
            path: The file.
            settings: The settings, applied in order.
            called: Name of a setting in messages.

        Raises:
            ConfigError: One line for each mistake, with its file, line and field.
        """
        return cls.of(Document.read(path).overridden(settings, called=called))

    @classmethod
    def of(cls, document: Document) -> Study:
        """Returns the validated experiments of a document.

        Raises:
            ConfigError: One line for each mistake.
        """
        made = combinations(document)
        experiments = {}
        for one in made:
            try:
                experiments[one.name] = one.document.validated(Experiment)
            except ConfigError as error:
                lines = str(error).splitlines()
                more = len(lines) - SHOWN
                shown = [*lines[:SHOWN], f"and {more} more"] if more > 0 else lines
                raise ConfigError("\n".join(shown)) from None
        lists: dict[str, list[Any]] = {".".join(keys): [] for keys in made[0].fields}
        for one in made:
            for keys in one.fields:
                value = _at(resolved(experiments[one.name]), keys)
                if value not in lists[".".join(keys)]:
                    lists[".".join(keys)].append(value)
        return cls(experiments, lists)

    def config(self) -> dict[str, Any]:
        """Returns a configuration to run again, as JSON: the first experiment with all lists."""
        return resolved(self._first) | ({"sweep": self.lists} if self.lists else {})


def _at(value: Any, keys: tuple[str, ...]) -> Any:
    for key in keys:
        value = value[int(key)] if isinstance(value, list) else value[key]
    return value
