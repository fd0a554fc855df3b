"""Scaffolding of a new plug-in package from Jinja templates."""

from __future__ import annotations

import keyword
import re
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import jinja2

from regkit.config.installed import Installed
from regkit.config.plugin import Plugin
from regkit.interfaces import (
    Dataset,
    Kernel,
    Method,
    Preprocessor,
    Segmenter,
    ShapeModel,
    Solver,
    Source,
    StartSearch,
    Template,
    Term,
    Tracker,
)
from regkit.system.errors import ConfigError
from regkit.system.files import creating_folder
from regkit.system.shipped import examples_folder

FOLDER = Path(__file__).parent
RECORDING = "data/human_walk"
"""Recording of a person, among the examples that come with regkit."""
CLOUDS = "data/lump/clouds"
"""Clouds of a rigid object, those of a new dataset."""
SUFFIX = ".jinja"
KINDS: dict[str, type[Plugin]] = {
    "shape": ShapeModel,
    "kernel": Kernel,
    "term": Term,
    "segmenter": Segmenter,
    "preprocessor": Preprocessor,
    "start": StartSearch,
    "solver": Solver,
    "method": Method,
    "tracker": Tracker,
    "template": Template,
    "dataset": Dataset,
    "source": Source,
}
"""The kinds of plug-ins that can be scaffolded, by their name on the command line."""


@dataclass(frozen=True)
class Scaffold:
    """A package with one plug-in, rendered from the templates in this folder.

    Attributes:
        what: The kind of plug-in, one of ``KINDS``.
        name: Name of the plug-in in YAML.
    """

    what: str
    name: str

    @classmethod
    def checked(cls, what: str, name: str) -> Self:
        """Returns the scaffold of a new plug-in.

        Args:
            what: The kind of plug-in.
            name: Name of the plug-in.

        Raises:
            ConfigError: If the kind is unknown, or the name is invalid or taken.
        """
        if what not in KINDS:
            raise ConfigError(
                f"there is no scaffold of a {what!r}; there are: {', '.join(KINDS)}", place="WHAT"
            )
        if not re.fullmatch(r"[a-z][a-z0-9]*(_[a-z0-9]+)*", name) or keyword.iskeyword(name):
            raise ConfigError(
                f"'{name}' cannot be a plug-in's name: use lower-case letters, digits and single "
                "underscores, begin with a letter, and avoid Python's keywords",
                place="NAME",
            )
        taken = KINDS[what].available().get(name)
        if taken is not None:
            by = taken.versions if isinstance(taken, Installed) else taken.__module__
            raise ConfigError(
                f"there is a {what} '{name}' already, of {by}; take another name", place="NAME"
            )
        return cls(what, name)

    @property
    def distribution(self) -> str:
        """Name of the distribution and of its folder."""
        return f"regkit-{self.name.replace('_', '-')}"

    @property
    def module(self) -> str:
        """Name of the Python package."""
        return f"regkit_{self.name}"

    @property
    def command(self) -> str:
        """Command that tries the plug-in, in the package's folder."""
        # Experiments have no sources.
        example = (FOLDER / self.what / f"example.yaml{SUFFIX}").is_file()
        return "regkit run example.yaml" if example else "regkit record data/ball.json recorded"

    def write(self, out: Path) -> Path:
        """Writes the package to a new folder in ``out``, and returns the folder.

        Raises:
            DataError: If the folder exists, or cannot be written.
        """
        folder = out / self.distribution
        with creating_folder(folder, "choose another name") as temporary:
            for file, text in self._files():
                path = temporary / file
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            self._copy_data(temporary)
        return folder

    def _files(self) -> Iterator[tuple[Path, str]]:
        """Yields the files of the package with their contents."""
        environment = jinja2.Environment(
            loader=jinja2.FileSystemLoader(FOLDER),
            undefined=jinja2.StrictUndefined,
            keep_trailing_newline=True,
            trim_blocks=True,
            autoescape=False,
        )
        values = {
            "what": self.what,
            "name": self.name,
            "group": KINDS[self.what].group,
            "distribution": self.distribution,
            "module": self.module,
            "class_name": "".join(map(str.capitalize, self.name.split("_"))) + self.what.title(),
            "recording": RECORDING,
            "command": self.command,
        }
        for folder in ("package", self.what):
            for path in sorted((FOLDER / folder).rglob("*")):
                if not path.is_file():
                    continue
                template = environment.get_template(path.relative_to(FOLDER).as_posix())
                place = path.relative_to(FOLDER / folder).as_posix().removesuffix(SUFFIX)
                place = place.replace("MODULE", self.module).replace("NAME", self.name)
                yield Path(place), template.render(values)

    def _copy_data(self, folder: Path) -> None:
        """Copies the data that the package's example names and that it does not contain yet."""
        file = folder / "example.yaml"
        example = file.read_text(encoding="utf-8") if file.is_file() else ""
        for name, source in (
            (RECORDING, examples_folder() / RECORDING),
            (CLOUDS, FOLDER / "dataset" / "data" / "lump"),
        ):
            if name in example:
                shutil.copytree(source, folder / name)
