"""An experiment's YAML with its sweep: one experiment or many."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from regkit.config.changes import Location
from regkit.config.document import Document
from regkit.config.model import Text
from regkit.experiment.experiment import Experiment
from regkit.experiment.resolved import resolved
from regkit.experiment.sweeps.sweep import combinations
from regkit.system.errors import ConfigError, RegkitError

SHOWN = 5
"""Maximum number of listed errors; a sweep repeats the same error many times."""


@dataclass(frozen=True)
class Study:
    """The experiments of a YAML file, by names that are valid as folders.

    Attributes:
        experiments: In the order of the sweep's lists. A single experiment has an empty name; its
            methods may be variants.
        lists: Values of the fields in which the experiments differ, in the same order.
        documents: The document of each experiment that was read from one, for messages.
    """

    experiments: dict[str, Experiment]
    lists: dict[str, list[Any]]
    documents: Mapping[str, Document] = field(default_factory=dict)

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
        return cls(experiments, lists, {one.name: one.document for one in made})

    @contextmanager
    def located(self, name: str) -> Iterator[None]:
        """Context manager whose errors about a field of an experiment name its file and line.

        Args:
            name: Name of the experiment in the study.
        """
        try:
            yield
        except RegkitError as error:
            document = self.documents.get(name)
            location = None if document is None else _location(document, error.place or "")
            if document is None or location is None:
                raise
            # The place was a path, unless it was the field itself.
            path = f"{error.place}: " if Path(error.place or "").is_absolute() else ""
            raise type(error)(path + error.message, place=document.place(location)) from None

    def config(self) -> dict[str, Any]:
        """Returns a configuration to run again, as JSON: the first experiment with all lists."""
        return resolved(self._first) | ({"sweep": self.lists} if self.lists else {})


def _location(document: Document, place: str) -> Location | None:
    """Returns the field of an experiment that an error's place names, or whose path it is."""
    dataset = document.data.get("dataset")
    for location in document.places:
        if location and ".".join(map(str, location)) == place:
            return location
    for name, value in dataset.items() if isinstance(dataset, dict) else ():
        folder = value.folder if isinstance(value, Text) else Path.cwd()
        if isinstance(value, str) and str(folder / value) == place:
            return ("dataset", name)
    return None


def _at(value: Any, keys: tuple[str, ...]) -> Any:
    for key in keys:
        value = value[int(key)] if isinstance(value, list) else value[key]
    return value
