"""Options that several commands have, and errors that name the option to be changed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer

from regkit.config.registry import run_plugin_file
from regkit.system.errors import RegkitError

TemplateName = Annotated[
    str | None,
    typer.Option(
        "--template",
        metavar="TEMPLATE",
        help="What is seen: a name such as human or hand, a template's YAML file, a rigid cloud or "
        "mesh, or a mapping such as '{kind: hand, side: left}'. (default: a person)",
        show_default=False,
    ),
]

MethodName = Annotated[
    str | None,
    typer.Option(
        "--method",
        metavar="METHOD",
        help="What registers it: a preset such as best or spheres, a kind, a preset's YAML file, "
        "or a mapping such as '{preset: best, terms: []}'. (default: regkit's best)",
        show_default=False,
    ),
]

PreprocessorName = Annotated[
    str | None,
    typer.Option(
        "--preprocessor",
        metavar="PREPROCESSOR",
        help="How a frame becomes data: a kind, or a mapping such as '{kind: points, voxel: 0.03, "
        "crop: {near: 2, far: 4}}'. (default: downsampled to some 900 points)",
        show_default=False,
    ),
]

Settings = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="a.b.c=VALUE",
        help="Change a value, such as template.height=1.75 or method.terms=[].",
    ),
]

Out = Annotated[
    Path | None,
    typer.Option(
        metavar="FOLDER",
        help="Write result.json, markers.csv, poses.npz and picture.png there.",
        show_default=False,
    ),
]

PluginFiles = Annotated[
    list[Path] | None,
    typer.Option(
        "--plugin", metavar="FILE", help="Python file that registers plug-ins of your own."
    ),
]


def run_plugin_files(files: Iterable[Path] | None) -> None:
    """Make the plug-ins of ``--plugin`` files available."""
    for file in files or ():
        run_plugin_file(file)


@contextmanager
def options(**names: str) -> Iterator[None]:
    """A context whose errors name options where the library names its arguments.

    Args:
        names: The option of each argument, such as ``voxel="--voxel"``.
    """
    try:
        yield
    except RegkitError as error:
        if error.place not in names:
            raise
        raise type(error)(error.message, place=names[error.place]) from None
