"""Writing of templates, each with its mesh and shape modes in files beside it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from regkit.body.description import BodyDescription
from regkit.body.modes import Modes
from regkit.body.writing import template_text
from regkit.config.document import Document
from regkit.config.schema_line import schema_line
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.errors import ConfigError, RegkitError
from regkit.system.files import write_text


def check_replaceable(out: Path, *, place: str = "--out") -> None:
    """Refuses to overwrite a file that is not a template, before any work is done.

    Args:
        out: The file to write.
        place: Name of the argument or option, for messages.

    Raises:
        ConfigError: If the file exists and is not a template.
    """
    if not out.exists():
        return
    try:
        Document.read(out).validated(BodyDescription)
    except RegkitError:
        raise ConfigError(
            f"{out} exists and is not a template; give another name", place=place
        ) from None


def skin_file(out: Path) -> Path:
    """Returns the file of the skin beside a template's file."""
    return out.with_name(f"{out.stem}_mesh.npz")


def modes_file(out: Path) -> Path:
    """Returns the file of the shape modes beside a template's file."""
    return out.with_name(f"{out.stem}_modes.npz")


def write_template(
    out: Path,
    description: BodyDescription,
    skin: SkinnedMesh | None,
    opening: str,
    comments: Mapping[str, str] | None = None,
    modes: Modes | None = None,
) -> None:
    """Writes a template, its mesh and its shape modes.

    If a schema of templates is nearby, the file names it for editors.

    Args:
        out: The file to write.
        description: The template.
        skin: Its mesh, written beside the file; None without one.
        opening: Comment at the top of the file.
        comments: Comments on joints, by joint.
        modes: Shape modes of the mesh, written beside the file; None without any.
    """
    if skin is not None:
        mesh = skin_file(out)
        skin.write(mesh)
        description = description.model_copy(update={"mesh": mesh})
    if modes is not None:
        beside = modes_file(out)
        modes.write(beside)
        description = description.model_copy(update={"modes": beside})
    line = schema_line(out, "template")
    text = template_text(description, opening, comments or {})
    write_text(out, text if line is None else f"{line}\n{text}")
