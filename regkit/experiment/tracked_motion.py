"""The motion in a results folder, with its body."""

from __future__ import annotations

import zipfile
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import TypeAdapter

from regkit.body import Body
from regkit.config.document import Document
from regkit.experiment.results_format import check_format
from regkit.geometry.rigid import rigid
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interchange.motion import TrackedMotion
from regkit.interfaces import Template
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError

NEEDED = ("root", "balls", "hinges", "markers", "size")
"""Arrays of ``poses.npz`` that define a motion."""

SAME = 1e-6
"""Tolerance [m] between stored markers and those of the body from the configuration."""


def read_tracked_motion(folder: Path, fps: float | None = None) -> TrackedMotion:
    """Returns the motion in ``RESULTS/METHOD/RECORDING``, with its body from the configuration.

    Args:
        folder: The folder of a finished recording.
        fps: Frames per second; by default those of the recording.

    Raises:
        RegkitError: If there is no finished recording, or the template has changed since.
    """
    arrays, results = _arrays(folder), folder.resolve().parents[1]
    check_format(results)
    given = _fps(folder, arrays) if fps is None else fps
    name = f"{folder.resolve().parent.name} {folder.resolve().name}"
    for template in _templates(results / "config.yaml"):
        body = template.body(float(arrays["size"]))
        transforms = _placed(body, arrays)
        if transforms is not None:
            skin = _skin(template, body)
            return TrackedMotion(name, body, transforms, arrays["hinges"], given, skin)
    raise DataError(
        "the template has changed since these poses were estimated; run the experiment again",
        place=str(folder),
    )


def _placed(body: Body, arrays: Mapping[str, NDArray[Any]]) -> Array | None:
    """Returns T_world_segment (T, S, 4, 4), or None if the body's markers are not the stored."""
    skeleton = body.skeleton
    shapes = {
        "balls": (len(skeleton.ball_links), 4),
        "hinges": (len(skeleton.hinge_links),),
        "markers": (len(body.markers.names), 3),
    }
    if any(arrays[name].shape[1:] != shape for name, shape in shapes.items()):
        return None
    poses = zip(arrays["root"], arrays["balls"], arrays["hinges"], strict=True)
    transforms = np.array([body.place(Pose(*pose)).transforms for pose in poses])
    placed = np.array([body.markers.place(one) for one in transforms])
    same = np.abs(placed - arrays["markers"]).max(initial=0.0) <= SAME
    return transforms if same else None


def _arrays(folder: Path) -> dict[str, NDArray[Any]]:
    """Returns the arrays of ``poses.npz``.

    Raises:
        ConfigError: If the file does not exist.
        DataError: If it is damaged.
    """
    file = folder / "poses.npz"
    if not file.is_file():
        others = sorted(folder.glob("**/poses.npz"))
        hint = f"; there are: {', '.join(str(other.parent) for other in others)}" if others else ""
        raise ConfigError(
            f"no poses.npz is here; give the folder of a finished recording, "
            f"RESULTS/METHOD/RECORDING{hint}",
            place=str(folder),
        )
    arrays = _read(file)
    missing = [name for name in NEEDED if name not in arrays]
    if missing:
        raise DataError(f"lacks the arrays {', '.join(missing)}", place=str(file))
    return arrays


def _fps(folder: Path, arrays: Mapping[str, NDArray[Any]]) -> float:
    """Returns the frame rate of the recording [1/s].

    Raises:
        ConfigError: If the results do not contain it.
    """
    record = folder / "record.npz"
    source = _read(record) if "fps" not in arrays and record.is_file() else arrays
    if "fps" not in source:
        raise ConfigError(
            f"the results in {folder} do not contain the frames per second; give them",
            place="fps",
        )
    return float(source["fps"])


def _read(file: Path) -> dict[str, NDArray[Any]]:
    try:
        with np.load(file) as content:
            return {key: content[key] for key in content.files}
    except (OSError, ValueError, EOFError, zipfile.BadZipFile) as error:
        raise DataError(f"damaged ({error})", place=str(file)) from None


def _templates(config: Path) -> tuple[Template, ...]:
    """Returns the templates of an experiment's configuration, without validating the rest.

    Raises:
        RegkitError: If there is none, or one is invalid.
    """
    document = Document.read(config)
    if "template" not in document.data:
        raise ConfigError("there is no template; this is not a results folder", place=str(config))
    subjects: dict[str, Template] = {}
    if "subjects" in document.data:
        subjects = document.field("subjects", TypeAdapter(dict[str, Template]).validate_python)
    return (Template.of(document, "template"), *subjects.values())


def _skin(template: Template, body: Body) -> SkinnedMesh | None:
    """Returns the template's mesh at the body's size."""
    description = template.description()
    if description.mesh is None:
        return None
    mesh = SkinnedMesh.read(description.mesh)
    scale = body.size / description.size.value
    rest = rigid(mesh.rest[:, :3, :3], scale * mesh.rest[:, :3, 3])
    return replace(mesh, vertices=scale * mesh.vertices, rest=rest)
