"""The folder of a track: what its body is, and its poses, from the first frame on.

TRACK/
track.json     recording, method, frames per second and the template's description
frames.rows    the values of all frames so far, while they are tracked
poses.npz      the same, when the track has ended
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from regkit import __version__
from regkit.body import Body, BodyDescription
from regkit.config.document import Document
from regkit.config.model import Model
from regkit.config.quantities import Length, Rate
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interchange.motion import TrackedMotion
from regkit.interfaces import Template
from regkit.system.archives import read_arrays
from regkit.system.arrays import Array
from regkit.system.digests import file_digest
from regkit.system.errors import ConfigError, DataError
from regkit.system.json_files import read_json, write_json
from regkit.system.notes import note
from regkit.tracking.frame_verdicts import verdicts_of
from regkit.tracking.rows import RowsInFile, read_rows
from regkit.tracking.stored_poses import checked_poses, placed
from regkit.tracking.track import Track

FILE, ROWS, POSES = "track.json", "frames.rows", "poses.npz"

FORMAT = 1
"""Incremented when a field of the folder's files is renamed or redefined."""

UNEVEN = 0.5
"""Frames that are off their time by more of a period than this are resampled for an export."""

LONGEST = 10
"""A motion is resampled to at most this many times its frames: a clock that jumps is no pause."""


class TrackDescription(Model):
    """The content of ``track.json``."""

    format: int
    """Version of the format."""
    regkit: str
    """Version of regkit that wrote it."""
    recording: str
    """Name of the recording or the camera."""
    method: str
    """Name of the method."""
    fps: Rate
    """Nominal frames per second."""
    size: Length
    """Size of the body [m]."""
    template: dict[str, Any]
    """Description of the template, without parameters of shape models."""
    mesh: str | None
    """SHA-256 of the template's mesh."""

    @classmethod
    def of(cls, recording: str, method: str, fps: float, size: float, template: Template) -> Self:
        """Returns the description of a track.

        Raises:
            RegkitError: If a file of the template cannot be read.
        """
        described = template.description()
        data = described.model_dump(mode="json", exclude={"shapes"})
        mesh = None if described.mesh is None else file_digest(described.mesh)
        return cls(
            format=FORMAT,
            regkit=__version__,
            recording=recording,
            method=method,
            fps=fps,
            size=size,
            template=data,
            mesh=mesh,
        )

    @classmethod
    def read(cls, folder: Path) -> Self:
        """Reads the description in a folder.

        Raises:
            RegkitError: If it is missing, damaged, or of another format.
        """
        file = folder / FILE
        content = read_json(file)
        written = content.get("format")
        if written != FORMAT:
            raise DataError(
                f"the format is {written!r}; regkit {__version__} reads format {FORMAT}",
                place=f"{file}: format",
            )
        return Document(content, {(): str(file)}).validated(cls)

    def write(self, folder: Path) -> None:
        """Writes the description into a folder.

        Raises:
            DataError: If it cannot be written.
        """
        write_json(folder / FILE, self.model_dump(mode="json"))

    def rows(self, folder: Path, body: Body, *, information: bool = False) -> RowsInFile:
        """Returns where the values of the frames are kept while they are tracked.

        Args:
            folder: The folder.
            body: The tracked body.
            information: Whether to keep what smoothing needs.

        Raises:
            DataError: If the file cannot be written.
        """
        # The poses of a former track in the folder would contradict the new description.
        (folder / POSES).unlink(missing_ok=True)
        self.write(folder)
        return RowsInFile(
            Track.layout(body, information=information), folder / ROWS, {"format": FORMAT}
        )

    def motion(self, folder: Path, fps: float | None = None) -> TrackedMotion:
        """Returns the motion in a folder, at a constant rate.

        Args:
            folder: The folder.
            fps: Frames per second; by default the recording's.

        Raises:
            RegkitError: If a file is missing or damaged.
        """
        arrays = _poses(folder, self.size)
        place = f"{folder / FILE}: template"
        data = {**self.template, "mesh": None, "modes": None}
        description = Document(data, {(): place}).validated(BodyDescription)
        body = description.body(self.recording, self.size)
        transforms = placed(body, arrays)
        if transforms is None:
            raise DataError(
                f"its markers are not those of the body in {FILE}", place=str(folder / POSES)
            )
        at = _even(arrays, self.fps, place=folder)
        verdicts = arrays["verdicts"][at]
        return TrackedMotion(
            f"{self.method} {self.recording}",
            body,
            transforms[at],
            arrays["hinges"][at],
            self.fps if fps is None else fps,
            self._skin(folder, self.size / description.size.value),
            verdicts=tuple(map(str, verdicts)),
        )

    def _skin(self, folder: Path, scale: float) -> SkinnedMesh | None:
        """Returns the body's mesh, if it is still there and the same."""
        if self.mesh is None:
            return None
        file = Path(str(self.template["mesh"]))
        try:
            same = file_digest(file) == self.mesh
        except OSError:
            same = False
        if same:
            return SkinnedMesh.read(file).scaled(scale)
        note(
            f"the template's mesh {file} is missing or has changed since; the motion is exported "
            "with bones and markers, without mesh and surface",
            place=folder,
        )
        return None


def finish_rows(folder: Path) -> None:
    """Removes the rows of a track whose poses are written."""
    (folder / ROWS).unlink(missing_ok=True)


def is_track_folder(folder: Path) -> bool:
    """Returns whether a folder holds a track."""
    return (folder / FILE).is_file()


def _poses(folder: Path, size: float) -> dict[str, NDArray[Any]]:
    """Returns the arrays of a track; of one that did not end, those that were written."""
    if (folder / POSES).is_file():
        what = "the poses of regkit track"
        return checked_poses(read_arrays(folder / POSES, what=what), folder / POSES, what)
    if not (folder / ROWS).is_file():
        raise ConfigError(
            f"there is no track here: neither {POSES} nor {ROWS} exists", place=str(folder)
        )
    what = "the frames of a track"
    rows, _ = read_rows(folder / ROWS, what)
    arrays: dict[str, NDArray[Any]] = {**rows, "size": np.array(size)}
    arrays = checked_poses(arrays, folder / ROWS, what)
    if not len(arrays["root"]):
        raise DataError("no frame was tracked", place=str(folder / ROWS))
    note(f"the track did not end; its {len(arrays['root'])} frames are read", place=folder)
    return arrays | {"verdicts": _verdicts(rows)}


def _verdicts(rows: Mapping[str, Array]) -> NDArray[np.str_]:
    return np.array(verdicts_of(rows), dtype=np.str_)


def _even(arrays: Mapping[str, NDArray[Any]], fps: float, *, place: Path) -> NDArray[np.intp]:
    """Returns the index of the frame that is shown in each period of the frame rate.

    Where frames are missing, the one before is held.
    """
    count = len(arrays["root"])
    each = np.arange(count)
    times = np.asarray(arrays.get("times", each / fps), dtype=np.float64)
    since = (times - times[0]) * fps
    if np.abs(since - each).max(initial=0.0) <= UNEVEN:
        return each
    if (np.diff(since) < 0.0).any() or since[-1] > LONGEST * count:
        note(
            f"the times of the {count} frames go back or jump; they are taken one after another, "
            f"at {fps:g} per second",
            place=place,
        )
        return each
    periods = np.arange(round(since[-1]) + 1)
    note(
        f"the {count} frames are not evenly spaced; the motion has {len(periods)} at {fps:g} per "
        "second, and where one is missing the one before it is held",
        place=place,
    )
    return np.maximum(np.searchsorted(since, periods + UNEVEN, side="right") - 1, 0)
