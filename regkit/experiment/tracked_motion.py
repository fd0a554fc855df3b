"""The motion in a results folder, with the body that moved."""

from __future__ import annotations

import zipfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from regkit.body import Body
from regkit.document import Document
from regkit.errors import ConfigError, DataError
from regkit.interchange.motion import TrackedMotion
from regkit.interfaces import Template
from regkit.model import Model
from regkit.rigid import rigid
from regkit.skeleton import Pose
from regkit.skinned_mesh import SkinnedMesh

SAME = 1e-6
"""A marker that is placed again lies so near to where it was [m]."""


class _Configuration(Model):
    """The part of an experiment's configuration that makes the body."""

    template: Template


def read_tracked_motion(folder: Path, fps: float | None = None) -> TrackedMotion:
    """The motion in ``RESULTS/METHOD/SEQUENCE``, and the body made again from the configuration.

    Args:
        folder: The folder of a finished sequence.
        fps: Frames per second, where they are not those that the sequence was recorded with.

    Raises:
        RegkitError: If there is no finished sequence, or the template is another one since.
    """
    arrays = _arrays(folder)
    template = _template(folder.resolve().parents[1] / "config.yaml")
    body = template.body(float(arrays["size"]))
    skeleton = body.skeleton
    shapes = {
        "balls": (len(skeleton.ball_links), 4),
        "hinges": (len(skeleton.hinge_links),),
        "markers": (len(body.markers.names), 3),
    }
    if any(arrays[name].shape[1:] != shape for name, shape in shapes.items()):
        raise _changed(folder)
    transforms = np.array(
        [
            body.place(Pose(root, balls, hinges)).transforms
            for root, balls, hinges in zip(
                arrays["root"], arrays["balls"], arrays["hinges"], strict=True
            )
        ]
    )
    placed = np.array([body.markers.place(one) for one in transforms])
    if np.abs(placed - arrays["markers"]).max(initial=0.0) > SAME:
        raise _changed(folder)
    given = fps if fps is not None else arrays.get("fps")
    if given is None:
        raise ConfigError(
            "the results do not say how many frames there were in a second; give --fps",
            place=str(folder),
        )
    name = f"{folder.parent.name} {folder.name}"
    return TrackedMotion(name, body, transforms, float(given), _skin(template, body))


def _arrays(folder: Path) -> dict[str, NDArray[Any]]:
    """The arrays of ``poses.npz``.

    Raises:
        ConfigError: If it is not there.
        DataError: If it is damaged.
    """
    file = folder / "poses.npz"
    needed = ("root", "balls", "hinges", "markers", "size")
    try:
        with np.load(file) as content:
            arrays: dict[str, NDArray[Any]] = {key: content[key] for key in content.files}
    except FileNotFoundError:
        others = sorted(folder.glob("**/poses.npz"))
        hint = f"; there are: {', '.join(str(other.parent) for other in others)}" if others else ""
        raise ConfigError(
            f"no poses.npz is here; name the folder of a finished sequence, "
            f"RESULTS/METHOD/SEQUENCE{hint}",
            place=str(folder),
        ) from None
    except (ValueError, EOFError, zipfile.BadZipFile) as error:
        raise DataError(f"damaged ({error})", place=str(file)) from None
    missing = [key for key in needed if key not in arrays]
    if missing:
        raise DataError(f"lacks the arrays {', '.join(missing)}", place=str(file))
    return arrays


def _template(config: Path) -> Template:
    """The template of an experiment's configuration, which need not be valid otherwise."""
    document = Document.read(config)
    if "template" not in document.data:
        raise ConfigError("there is no template; this is no results folder", place=str(config))
    places = {at: place for at, place in document.places.items() if at[:1] in ((), ("template",))}
    own = Document({"template": document.data["template"]}, places)
    return own.validated(_Configuration).template


def _skin(template: Template, body: Body) -> SkinnedMesh | None:
    """The template's mesh at the body's size."""
    description = template.description()
    if description.mesh is None:
        return None
    mesh = SkinnedMesh.read(description.mesh)
    scale = body.size / description.size.value
    rest = rigid(mesh.rest[:, :3, :3], scale * mesh.rest[:, :3, 3])
    return replace(mesh, vertices=scale * mesh.vertices, rest=rest)


def _changed(folder: Path) -> DataError:
    return DataError(
        "the template is not the one that these poses were found with: it was changed since; run "
        "the experiment again",
        place=str(folder),
    )
