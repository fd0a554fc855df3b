"""Everything but the recordings that results depend on: versions, code, templates, other files."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any, Self

from pydantic import TypeAdapter

from regkit.body import Body, BodyDescription
from regkit.config.document import Document
from regkit.config.plugin import Plugin, plugins_in
from regkit.experiment.differences import differences
from regkit.experiment.experiment import Experiment
from regkit.experiment.provenance.code import code, versions
from regkit.experiment.provenance.listing import files_by_name
from regkit.interfaces import Template
from regkit.system.digests import Stamp, file_digest
from regkit.system.errors import ConfigError, DataError
from regkit.system.guard import reading
from regkit.system.json_files import write_json

FILE = "setup.json"

EXTENDED = " extended"
"""What follows the field of a template whose extended one a start may choose."""


@dataclass(frozen=True)
class Setup:
    """What an experiment's results depend on beside its configuration and its recordings.

    Attributes:
        versions: Of regkit, of numerical libraries, and of the plug-ins' distributions.
        code: Digests of the code of the plug-ins, by package or file.
        files: Digests of the files that templates and other plug-ins read, by field and name.
        templates: Descriptions of the templates, by field, and of those that a start may choose in
            their place. ``regkit export`` needs no other file.
    """

    versions: dict[str, str]
    code: dict[str, str]
    files: dict[str, str]
    templates: dict[str, dict[str, Any]]

    @classmethod
    def of(cls, experiment: Experiment) -> Self:
        """Returns the present setup of an experiment.

        Raises:
            RegkitError: If a file is missing or cannot be read.
        """
        plugins = dict(plugins_in(experiment))
        files: dict[str, str] = {}
        templates: dict[str, dict[str, Any]] = {}
        for field, plugin in plugins.items():
            if isinstance(plugin, Template):
                templates[field] = _described(plugin)
                extended = plugin.extended()
                if extended is not None:
                    templates[f"{field}{EXTENDED}"] = _described(extended)
            if field.partition(".")[0] != "dataset":
                files.update(_digests(field, plugin))
        return cls(versions(plugins.values()), code(plugins.values()), files, templates)

    @classmethod
    def read(cls, folder: Path) -> Self:
        """Returns the setup in a results folder.

        Raises:
            DataError: If the file is missing or damaged.
        """
        file = folder / FILE
        with reading(file, "a setup of regkit run"):
            setup: Self = TypeAdapter(cls).validate_json(file.read_bytes())
            return setup

    def body(self, field: str, name: str, size: float, folder: Path) -> Body:
        """Returns the body of a template of the run, without its shapes and surface.

        Args:
            field: Field of the experiment with the template.
            name: Name of the body.
            size: Size of the body [m].
            folder: The results folder, for messages.

        Raises:
            ConfigError: If the description is damaged.
        """
        data = {**self.templates[field], "mesh": None, "modes": None}
        document = Document(data, {(): f"{folder / FILE}: {field}"})
        return document.validated(BodyDescription).body(name, size)

    def holds(self, field: str, template: Template) -> bool:
        """Whether a template and its files are those of the run.

        Raises:
            RegkitError: If one of its files is missing or invalid.
        """
        files = {name: one for name, one in self.files.items() if name.startswith(f"{field}: ")}
        same = not list(_of_templates(field, self.templates[field], _described(template)))
        return same and files == dict(_digests(field, template))

    def write(self, folder: Path) -> None:
        """Writes the setup into a results folder."""
        write_json(folder / FILE, asdict(self))

    def check(self, folder: Path, *, part: bool = False) -> None:
        """Refuses to add to results of another setup.

        Args:
            folder: The results folder.
            part: Whether this is the setup of a part of the experiment.

        Raises:
            ConfigError: If the setup has changed; the message names what.
            DataError: If the folder's setup is missing or damaged.
        """
        there = Setup.read(folder)
        found = list(there._changes(self, part=part))
        if found:
            raise ConfigError(
                f"the folder holds results of another setup: {', '.join(found)}; choose another "
                "folder, or restore what was there",
                place=str(folder),
            )

    def _changes(self, now: Setup, *, part: bool) -> Iterator[str]:
        for field in fields(self):
            before, after = getattr(self, field.name), getattr(now, field.name)
            names = after if part else {**before, **after}
            for name in names:
                if field.name == "versions" and before.get(name) != after.get(name):
                    told = [one.get(name, "not installed") for one in (before, after)]
                    yield f"{name} is {told[0]} there and {told[1]} here"
                elif field.name == "templates":
                    yield from _of_templates(name, before.get(name), after.get(name))
                elif before.get(name) != after.get(name):
                    kind = "the code of " if field.name == "code" else ""
                    yield f"{kind}{name} {_change(name in before, name in after)}"


def _described(template: Template) -> dict[str, Any]:
    """Returns a template's description without the parameters of shape models."""
    return template.description().model_dump(mode="json", exclude={"shapes"})


def _digests(field: str, plugin: Plugin) -> Iterator[tuple[str, str]]:
    """Yields names and digests of the files that a plug-in reads."""
    for name, path in files_by_name(plugin.input_files()).items():
        try:
            yield f"{field}: {name}", file_digest(path, Stamp.of(path))
        except OSError as error:
            raise DataError(f"cannot be read: {error.strerror or error}", place=path) from None


def _change(before: bool, after: bool) -> str:
    return "has changed" if before and after else "is new" if after else "is gone"


def _of_templates(field: str, before: Any, after: Any) -> Iterator[str]:
    # The contents of mesh and modes are files'; their places do not matter.
    there, here = ({**(one or {}), "mesh": None, "modes": None} for one in (before, after))
    if there != here:
        yield differences({field: there}, {field: here})
