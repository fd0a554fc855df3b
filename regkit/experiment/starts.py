"""The start of each recording, found once and stored, so that all methods begin equally."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Self

import numpy as np
from pydantic import TypeAdapter

from regkit.body.verdict import Verdict
from regkit.interfaces import Start, StartSearch, Template
from regkit.skeleton import Pose
from regkit.system.digests import data_digest
from regkit.system.errors import DataError, RegkitError
from regkit.system.guard import reading
from regkit.system.json_files import write_json
from regkit.system.notes import note
from regkit.tracking import Session


def start_file(folder: Path, recording: str) -> Path:
    """Returns the file of a recording's start in a results folder."""
    return folder / "starts" / f"{recording}.json"


@dataclass(frozen=True)
class StoredStart:
    """A start as stored; JSON keeps floating-point numbers to the last bit.

    Attributes:
        inputs: Digest of the recording's content in which it was found.
        size: Size of the body [m].
        root: T_camera_root (4, 4) [m].
        balls: Unit quaternions of the ball joints (n_ball, 4).
        hinges: Hinge angles (n_hinge,) [rad].
        verdict: Whether the body was found.
        reason: Why it is not surely found.
        margin: Advantage over the best other pose; None if there was none.
        extended: Whether the body is that of the extended template.
        checksum: Digest of the other fields.
    """

    inputs: str
    size: float
    root: list[list[float]]
    balls: list[list[float]]
    hinges: list[float]
    verdict: Verdict
    reason: str
    margin: float | None
    extended: bool = False
    checksum: str = ""

    @classmethod
    def of(cls, start: Start, inputs: str) -> Self:
        """Returns a start in the form in which it is stored."""
        pose = start.pose
        arrays = (pose.root.tolist(), pose.balls.tolist(), pose.hinges.tolist())
        margin = float(start.margin) if np.isfinite(start.margin) else None
        judged = (start.verdict, start.reason, margin)
        plain = cls(inputs, float(start.body.size), *arrays, *judged, start.extended)
        return cls(**asdict(plain) | {"checksum": plain.digest()})

    @classmethod
    def read(cls, file: Path) -> Self:
        """Returns the stored start.

        Raises:
            DataError: If it is missing, damaged, or not what was written.
        """
        with reading(file, "a start"):
            stored: Self = TypeAdapter(cls).validate_json(file.read_bytes())
            if stored.checksum != stored.digest():
                raise DataError("damaged: it is not what the run wrote")
            return stored

    def digest(self) -> str:
        """Returns the digest of all fields but the checksum."""
        return data_digest(asdict(self) | {"checksum": ""})

    def start(self, template: Template) -> Start:
        """Returns the start of a template's body."""
        body = template.chosen(extended=self.extended).body(self.size)
        rest = body.skeleton.rest()
        pose = Pose(
            np.array(self.root, dtype=float).reshape(rest.root.shape),
            np.array(self.balls, dtype=float).reshape(rest.balls.shape),
            np.array(self.hinges, dtype=float).reshape(rest.hinges.shape),
        )
        margin = float("nan") if self.margin is None else self.margin
        judged = (self.verdict, self.reason, margin)
        return Start(body, pose, *judged, extended=self.extended)


def kept_start(session: Session, folder: Path, inputs: str) -> Start:
    """Returns the session's given start, the stored one, or a newly found one.

    A stored start of other content, or a damaged one, is found again.

    Args:
        session: The recording with its template.
        folder: The results folder.
        inputs: Digest of the recording's content.

    Raises:
        RegkitError: If no start is found.
    """
    if not (isinstance(session.start, StartSearch) and session.start.searches):
        return session.begin()
    file = start_file(folder, session.recording.name)
    if file.exists():
        try:
            stored = StoredStart.read(file)
        except RegkitError as error:
            note(f"{error.message}; the start is found again", place=file)
        else:
            if stored.inputs == inputs:
                return stored.start(session.template)
    found = StoredStart.of(session.begin(), inputs)
    write_json(file, asdict(found))
    return found.start(session.template)
