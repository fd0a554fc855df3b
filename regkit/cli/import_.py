"""``regkit import``."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated

import typer

from regkit.body.template_file import (
    check_replaceable,
    modes_file,
    skin_file,
    write_template,
)
from regkit.cli.console import output
from regkit.cli.import_texts import opening_of, print_summary
from regkit.cli.options import PluginFiles, options, run_plugin_files
from regkit.fitting.body_model import body_model_template
from regkit.fitting.template import parameters_of
from regkit.interchange.body_model.model_file import SUFFIXES
from regkit.interchange.body_model.smpl import MODES
from regkit.interchange.skeletons import read_skeleton
from regkit.system.errors import ConfigError, RegkitError
from regkit.system.progress import working


def import_(
    file: Annotated[
        Path,
        typer.Argument(
            metavar="FILE",
            help="A .bvh or .urdf file, or a body model in the layout of SMPL: .npz or .pkl, of "
            "which nothing is executed.",
            show_default=False,
        ),
    ],
    out: Annotated[Path, typer.Option(metavar="FILE", help="Template to write.")] = Path(
        "imported.yaml"
    ),
    scale: Annotated[
        float, typer.Option(help="Metres per unit of the file, such as 0.01 for centimetres.")
    ] = 1.0,
    title: Annotated[
        str | None,
        typer.Option(
            "--name",
            metavar="TEXT",
            help="Title of the template. (default: the file's name)",
            show_default=False,
        ),
    ] = None,
    up: Annotated[
        str | None,
        typer.Option(
            metavar="AXIS",
            help="The file's upward axis, such as y or -z. (default: z for URDF, y for others)",
            show_default=False,
        ),
    ] = None,
    front: Annotated[
        str | None,
        typer.Option(
            metavar="AXIS",
            help="The file's forward axis. (default: x for URDF, z for others)",
            show_default=False,
        ),
    ] = None,
    package: Annotated[
        list[Path] | None,
        typer.Option(
            metavar="DIR",
            help="Folder of a package, or of packages, with the meshes of a URDF file; may be "
            "repeated. (default: ROS_PACKAGE_PATH, and the folders above the file)",
            show_default=False,
        ),
    ] = None,
    modes: Annotated[
        int | None,
        typer.Option(
            min=0,
            metavar="N",
            help=f"Number of a body model's shape modes to take. (default: {MODES})",
            show_default=False,
        ),
    ] = None,
    vertices: Annotated[
        int | None,
        typer.Option(
            min=50,
            metavar="N",
            help="Number of a body model's vertices to keep, evenly spread. (default: all)",
            show_default=False,
        ),
    ] = None,
    shape: Annotated[
        list[str] | None,
        typer.Option(
            metavar="KIND",
            help="Also fit this shape model to a body model's surface, with one primitive per "
            "segment; may be repeated. (default: primitives follow from the capsules)",
            show_default=False,
        ),
    ] = None,
    plugin: PluginFiles = None,
) -> None:
    """Create a template from another program's skeleton or body model: BVH, URDF, SMPL."""
    run_plugin_files(plugin)
    if not 0.0 < scale < float("inf"):
        raise ConfigError(f"the scale is {scale:g}; it must be positive", place="--scale")
    for folder in package or ():
        if not folder.is_dir():
            raise ConfigError(f"{folder} is not a folder", place="--package")
    check_replaceable(out)
    _check_given(file, {"--modes": modes, "--vertices": vertices, "--shape": shape})
    for kind in shape or ():
        try:
            parameters_of(kind)
        except RegkitError as error:
            raise error.at(f"--shape {kind}") from None
    model = file.suffix.lower() in SUFFIXES
    with options(up="--up", front="--front"), working("importing"):
        if model:
            imported = body_model_template(
                file,
                scale=scale,
                title=title,
                up=up,
                front=front,
                modes=MODES if modes is None else modes,
                vertices=vertices,
                shapes=shape or (),
            )
        else:
            imported = read_skeleton(
                file, scale=scale, title=title, up=up, front=front, packages=package or ()
            )
    given = {
        "--scale": f"{scale:g}" if scale != 1.0 else None,
        "--up": up,
        "--front": front,
        "--modes": modes,
        "--vertices": vertices,
        "--shape": shape,
    }
    opening = opening_of(imported, file, out, given, is_model=model)
    write_template(
        out, imported.description, imported.skin, opening, imported.comments, imported.modes
    )
    print_summary(imported)
    beside = [] if imported.skin is None else [skin_file(out)]
    beside += [] if imported.modes is None else [modes_file(out)]
    output.print(f"written: {' and '.join(map(str, [out, *beside]))}")
    output.print(f"template: {{kind: file, path: {out}}}")


def _check_given(file: Path, given: Mapping[str, object]) -> None:
    """Checks that the options of body models are given for body models.

    Raises:
        ConfigError: If they are not.
    """
    named = [option for option, value in given.items() if value not in (None, [])]
    if named and file.suffix.lower() not in SUFFIXES:
        raise ConfigError(
            f"{file.name} is no body model ({', '.join(SUFFIXES)}), which alone has shape modes "
            "and a surface of its own",
            place=named[0],
        )
