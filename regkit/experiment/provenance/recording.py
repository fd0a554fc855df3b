"""The content of a recording, with which results on it are bound to it."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Self

from pydantic import TypeAdapter

from regkit.config.plugin import plugins_in
from regkit.experiment.provenance.listing import files_by_name
from regkit.interfaces import Dataset, Recording
from regkit.system.digests import Stamp, data_digest, file_digest
from regkit.system.errors import DataError, RegkitError
from regkit.system.files import write_text
from regkit.system.guard import reading

SHOWN = 3
"""Maximum number of listed changes."""

File = tuple[Stamp, str]
"""Stamp and digest of a file."""


@dataclass(frozen=True)
class RecordingInputs:
    """The content of a recording.

    Attributes:
        recording: Number of frames, frames per second, subject, and the recording's fingerprint.
        files: Stamp and digest of each file, by its name relative to the others. Stamps only tell
            which files must be read again: a copy or ``touch`` is no change.
    """

    recording: dict[str, int | float | str | None]
    files: dict[str, File] = field(default_factory=dict)

    @classmethod
    def of(cls, recording: Recording, dataset: Dataset, known: Self | None = None) -> Self:
        """Returns the present content; of the files only those with a new stamp are read.

        Args:
            recording: The recording.
            dataset: Its dataset.
            known: The content as it was.

        Raises:
            RegkitError: If a file cannot be read.
        """
        about = {name: getattr(recording, name) for name in ("length", "fps", "subject")}
        about["fingerprint"] = recording.fingerprint()
        paths = recording.input_files()
        if paths is None:
            paths = [path for _, one in plugins_in(dataset) for path in one.input_files() or ()]
        before = {} if known is None else known.files
        files = {}
        for name, path in files_by_name(paths).items():
            try:
                stamp = Stamp.of(path)
                stored, digest = before.get(name, (None, ""))
                files[name] = (stamp, digest if stored == stamp else file_digest(path, stamp))
            except OSError as error:
                raise DataError(f"cannot be read: {error.strerror or error}", place=path) from None
        return cls(about, files)

    @cached_property
    def digest(self) -> str:
        """The digest of the content, which does not depend on places and times."""
        return data_digest([self.recording, {name: one for name, (_, one) in self.files.items()}])

    def check(self, recording: Recording, dataset: Dataset) -> None:
        """Checks that the content is still the same.

        Raises:
            DataError: If it has changed.
        """
        now = self.of(recording, dataset, self)
        if now.digest != self.digest:
            raise DataError(
                f"the data have changed during the run: {self.changes(now)}; run it again",
                place=recording.name,
            )

    def changes(self, now: Self) -> str:
        """Returns in a few words what of the content differs from that of ``now``."""
        found = list(self._changes(now))
        more = len(found) - SHOWN
        return ", ".join(found[:SHOWN]) + (f", and {more} more" if more > 0 else "")

    def _changes(self, now: Self) -> Iterator[str]:
        for name in {**self.files, **now.files}:
            if name not in now.files:
                yield f"{name} is gone"
            elif name not in self.files:
                yield f"{name} is new"
            elif self.files[name][1] != now.files[name][1]:
                yield f"{name} has changed"
        for name, value in now.recording.items():
            before = self.recording.get(name)
            if before != value:
                yield ("what it is computed from has changed" if name == "fingerprint"
                       else f"{name} was {before} and is {value}")  # fmt: skip

    @classmethod
    def read(cls, file: Path) -> Self:
        """Returns the content as it was written.

        Raises:
            DataError: If the file is missing or damaged.
        """
        with reading(file, "a list of a recording's files"):
            inputs: Self = TypeAdapter(cls).validate_json(file.read_bytes())
            return inputs

    @classmethod
    def known(cls, file: Path) -> Self | None:
        """Returns the content as it was written, or None; everything can be read again."""
        with suppress(RegkitError):
            return cls.read(file)
        return None

    def write(self, file: Path) -> None:
        """Writes the content, a line for each file."""
        lines = [f"{json.dumps(name)}: {json.dumps(one)}" for name, one in self.files.items()]
        about = json.dumps(self.recording)
        listed = ",\n".join(lines)
        write_text(file, f'{{"recording": {about}, "files": {{\n{listed}\n}}}}\n')


def inputs_file(folder: Path, recording: str) -> Path:
    """Returns the file of a recording's content in a results folder."""
    return folder / "inputs" / f"{recording}.json"


def prepared_inputs(folder: Path, recording: Recording, dataset: Dataset) -> RecordingInputs:
    """Returns a recording's content as it was prepared in this run.

    Raises:
        DataError: If it has changed since; methods would be compared on different data.
    """
    known = RecordingInputs.read(inputs_file(folder, recording.name))
    known.check(recording, dataset)
    return known


def kept_inputs(folder: Path, recording: Recording, dataset: Dataset) -> RecordingInputs:
    """Returns a recording's present content, and keeps it in the results folder.

    Raises:
        RegkitError: If a file cannot be read.
    """
    file = inputs_file(folder, recording.name)
    known = RecordingInputs.known(file)
    now = RecordingInputs.of(recording, dataset, known)
    if known != now:
        now.write(file)
    return now
