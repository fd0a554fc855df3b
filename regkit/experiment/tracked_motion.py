"""The motion in a results folder, with its body."""

from __future__ import annotations

import os
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from regkit.body import Body
from regkit.config.document import Document
from regkit.experiment.provenance import manifest
from regkit.experiment.provenance.manifest import Manifest
from regkit.experiment.provenance.setup import EXTENDED, Setup
from regkit.experiment.results_format import check_format
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interchange.motion import TrackedMotion
from regkit.interfaces import Template
from regkit.system.archives import read_arrays
from regkit.system.errors import ConfigError, DataError, RegkitError
from regkit.system.guard import reading
from regkit.system.links import check_links
from regkit.system.notes import note
from regkit.tracking.stored_poses import checked_poses, placed


def read_tracked_motion(folder: Path, fps: float | None = None) -> TrackedMotion:
    """Returns the motion in ``RESULTS/METHOD/RECORDING``, with its body from ``setup.json``.

    The bones and markers of the run's templates are in the results; a mesh is read from its place,
    if it is still that of the run.

    Args:
        folder: The folder of a finished recording.
        fps: Frames per second; by default those of the recording.

    Raises:
        RegkitError: If there is no finished track, or a file of it is damaged.
    """
    results = Path(os.path.abspath(folder)).parent.parent  # noqa: PTH100 - links must remain.
    if (results / "config.yaml").exists():
        check_links(results)
    arrays = _arrays(folder)
    check_format(results)
    given = _fps(folder, arrays) if fps is None else fps
    name = f"{folder.resolve().parent.name} {folder.resolve().name}"
    setup, size = Setup.read(results), float(arrays["size"])
    for field in setup.templates:
        template = _present(results, field, setup)
        body = setup.body(field, name, size, results) if template is None else template.body(size)
        transforms = placed(body, arrays)
        if transforms is not None:
            skin = None
            if template is not None:
                skin = _skin(template, body)
            elif setup.files:
                note(
                    "the template's files are missing or have changed since the run; the motion is "
                    "exported with the run's bones and markers, without mesh and surface",
                    place=str(results),
                )
            verdicts = tuple(map(str, arrays["verdicts"])) if "verdicts" in arrays else None
            return TrackedMotion(
                name, body, transforms, arrays["hinges"], given, skin, verdicts=verdicts
            )
    raise DataError(
        "no template of the run has these markers; run the experiment again", place=str(folder)
    )


def _arrays(folder: Path) -> dict[str, NDArray[Any]]:
    """Returns the arrays of ``poses.npz`` of a finished track, whose files are intact.

    Raises:
        ConfigError: If there is no finished track.
        DataError: If it is damaged, or of another format.
    """
    results = folder.resolve().parents[1] if len(folder.resolve().parents) > 1 else folder
    if not (folder / "poses.npz").is_file() and not (folder / manifest.FILE).is_file():
        others = sorted(folder.glob(f"**/{manifest.FILE}"))
        hint = f"; there are: {', '.join(str(other.parent) for other in others)}" if others else ""
        lack = "no finished track is here" if folder.exists() else "there is no such folder"
        raise ConfigError(
            f"{lack}; give the folder of a finished recording, RESULTS/METHOD/RECORDING, or of "
            f"`regkit track`{hint}",
            place=str(folder),
        )
    check_format(results)
    track = Manifest.read(folder)
    if track is None:
        raise ConfigError(
            f"the track is not finished ({manifest.FILE} is missing); continue the run",
            place=str(folder),
        )
    track.check(folder)
    file = folder / "poses.npz"
    what = "the poses of regkit run"
    return checked_poses(read_arrays(file, what=what), file, what)


def _fps(folder: Path, arrays: Mapping[str, NDArray[Any]]) -> float:
    """Returns the frame rate of the recording [1/s].

    Raises:
        ConfigError: If the results do not contain it.
    """
    record = folder / "record.npz"
    source = arrays if "fps" in arrays else read_arrays(record, what="a record of regkit run")
    if "fps" not in source:
        raise ConfigError(
            f"the results in {folder} do not contain the frames per second; give them",
            place="fps",
        )
    with reading(record, "a record of regkit run"):
        return float(source["fps"].item())


def _present(results: Path, field: str, setup: Setup) -> Template | None:
    """Returns the template in ``config.yaml``, if it is still that of the run."""
    with suppress(RegkitError, KeyError, TypeError):
        document = Document.read(results / "config.yaml")
        plain = field.removesuffix(EXTENDED)
        head, _, subject = plain.partition(".")
        data = document.data[head][subject] if subject else document.data[head]
        template = Template.of(Document({head: data}, document.places), head)
        there = setup.holds(plain, template)
        return template.chosen(extended=field != plain) if there else None
    return None


def _skin(template: Template, body: Body) -> SkinnedMesh | None:
    """Returns the template's mesh at the body's size."""
    description = template.description()
    if description.mesh is None:
        return None
    mesh = SkinnedMesh.read(description.mesh)
    return mesh.scaled(body.size / description.size.value)
