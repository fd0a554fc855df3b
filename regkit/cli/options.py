"""Options of several commands, and errors that name the option to change."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer

from regkit.cli.completion import plugin_names
from regkit.config.defaults import default_name
from regkit.config.registry import run_plugin_file
from regkit.system.errors import PluginError, RegkitError


def default_of(group: str, purpose: str = "") -> str:
    """Returns the name of the declared default of a group, such as methods, for a help text."""
    try:
        return default_name(f"regkit.{group}", purpose)
    except PluginError:
        return "none is installed"


TemplateName = Annotated[
    str | None,
    typer.Option(
        "--template",
        metavar="TEMPLATE",
        autocompletion=plugin_names("template"),
        help="Body to register: a name such as human or hand, a template's YAML file, a rigid "
        "cloud or mesh, or a mapping such as '{kind: hand, side: left}'. "
        f"(default: {default_of('templates')})",
        show_default=False,
    ),
]

MethodName = Annotated[
    str | None,
    typer.Option(
        "--method",
        metavar="METHOD",
        autocompletion=plugin_names("method"),
        help="Method: a preset such as best or spheres, a kind, a preset's YAML file, or a mapping "
        f"such as '{{preset: best, terms: []}}'. (default: {default_of('methods')})",
        show_default=False,
    ),
]

PreprocessorName = Annotated[
    str | None,
    typer.Option(
        "--preprocessor",
        metavar="PREPROCESSOR",
        autocompletion=plugin_names("preprocessor"),
        help="Preprocessing of a frame: a kind, or a mapping such as '{kind: points, voxel: 0.03, "
        "crop: {near: 2, far: 4}}'. (default: downsample to about 900 points)",
        show_default=False,
    ),
]

Segmentation = Annotated[
    str | None,
    typer.Option(
        "--segmentation",
        metavar="SEGMENTERS",
        autocompletion=plugin_names("segmentation"),
        help="Segmenters that take the body out of the scene, in order: names such as "
        "background,pieces, a YAML list such as '[ planes, {kind: pieces, choose: moving} ]', or "
        f"[] for none. (default: {default_of('segmenters')})",
        show_default=False,
    ),
]

Settings = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="a.b.c=VALUE",
        help="Change a value, such as template.height=1.75 or method.terms=[]. Repeatable.",
    ),
]

Out = Annotated[
    Path | None,
    typer.Option(
        metavar="FOLDER",
        help="Write result.json, markers.csv, hinges.csv, frames.csv, poses.npz and picture.png to "
        "this folder.",
        show_default=False,
    ),
]

Strict = Annotated[
    bool,
    typer.Option("--strict", help="Exit with 3 if the result is doubtful, not only if it is lost."),
]

PluginFiles = Annotated[
    list[Path] | None,
    typer.Option(
        "--plugin",
        metavar="FILE",
        help="Python file that registers your own plug-ins; its code is run. Repeatable.",
    ),
]


def run_plugin_files(files: Iterable[Path] | None) -> None:
    """Makes the plug-ins of ``--plugin`` files available."""
    for file in files or ():
        run_plugin_file(file)


@contextmanager
def options(**names: str) -> Iterator[None]:
    """Context manager whose errors name options in place of the library's arguments.

    Args:
        names: The option of each argument, such as ``voxel="--voxel"``.
    """
    try:
        yield
    except RegkitError as error:
        if error.place not in names:
            raise
        raise type(error)(error.message, place=names[error.place]) from None
