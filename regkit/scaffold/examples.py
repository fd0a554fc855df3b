"""Examples that come with regkit, each with the data that it needs."""

from __future__ import annotations

import ast
import shutil
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from regkit.config.document import Document
from regkit.config.first_sentence import first_sentence, opening_sentence
from regkit.config.model import did_you_mean
from regkit.config.parts import parts_of
from regkit.config.schema_line import MARK
from regkit.system.errors import ConfigError
from regkit.system.files import creating_folder
from regkit.system.shipped import examples_folder


@dataclass(frozen=True)
class Example:
    """An experiment, or a Python file, with its data.

    Attributes:
        file: The experiment's YAML file, or the Python file.
    """

    file: Path

    @classmethod
    def named(cls, name: str) -> Example:
        """Returns an example.

        Raises:
            ConfigError: If there is no such example.
        """
        known = {one.name: one for one in examples()}
        if name not in known:
            raise ConfigError(
                f"no example '{name}' (there are: {', '.join(known)})"
                + did_you_mean(name, [*known]),
                place="NAME",
            )
        return known[name]

    @property
    def name(self) -> str:
        """Name on the command line."""
        return self.file.stem

    @property
    def summary(self) -> str:
        """First sentence of the file's opening comment or docstring."""
        text = self.file.read_text(encoding="utf-8")
        if self.file.suffix == ".py":
            return first_sentence(ast.get_docstring(ast.parse(text)) or "")
        return opening_sentence(text)

    @property
    def data(self) -> list[Path]:
        """Files and folders that the experiment names and that come with it, relative to it."""
        if self.file.suffix == ".py":
            return []
        folder = self.file.parent
        return [path.relative_to(folder) for path in dict.fromkeys(_files(self.file))]

    @property
    def command(self) -> str:
        """Command that runs the copy, in its folder."""
        if self.file.suffix == ".py":
            if "__main__" in self.file.read_text(encoding="utf-8"):
                return f"python {self.file.name}"
            return f"regkit plugins {self.name} --plugin {self.file.name}"
        root = Document.read(self.file).data["dataset"].get("root")
        missing = root is not None and not (self.file.parent / root).exists()
        return f"regkit run {self.file.name}" + (" --set dataset.root=FOLDER" if missing else "")

    def copy(self, out: Path) -> Path:
        """Copies the example to a new folder of its name in ``out``, and returns the folder.

        Raises:
            DataError: If the folder exists, or cannot be written.
        """
        folder = out / self.name
        with creating_folder(folder, "choose another one with --out") as temporary:
            for path in self.data:
                source, target = self.file.parent / path, temporary / path
                target.parent.mkdir(parents=True, exist_ok=True)
                if source.is_dir():
                    shutil.copytree(source, target, dirs_exist_ok=True)
                else:
                    shutil.copyfile(source, target)
            # The schema lies elsewhere, relative to the copy.
            lines = self.file.read_text(encoding="utf-8").splitlines(keepends=True)
            text = "".join(line for line in lines if not line.startswith(MARK))
            (temporary / self.file.name).write_text(text, encoding="utf-8")
        return folder


def examples() -> list[Example]:
    """Returns all examples, sorted by name.

    Raises:
        DataError: If this installation has none.
    """
    files = [*examples_folder().glob("*.yaml"), *examples_folder().glob("*.py")]
    return [Example(file) for file in sorted(files)]


def _files(file: Path) -> Iterator[Path]:
    """Yields the files and folders that a YAML file names, and those that these name."""
    for text in _texts(Document.read(file).data):
        path = file.parent / text
        # A text may be longer than a name can be.
        with suppress(OSError):
            if path.exists() and path != file.parent:
                yield path
                if path.suffix == ".yaml":
                    yield from _files(path)


def _texts(data: Any) -> Iterator[str]:
    """Yields all texts in a YAML document."""
    if isinstance(data, str):
        yield data
    for part in parts_of(data).values():
        yield from _texts(part)
