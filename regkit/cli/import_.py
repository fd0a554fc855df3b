"""``regkit import``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from regkit.body.template_file import (
    check_replaceable,
    modes_file,
    skin_file,
    write_template,
)
from regkit.cli.console import output, print_warning
from regkit.cli.options import PluginFiles, options, run_plugin_files
from regkit.fitting.body_model import body_model_template
from regkit.fitting.template import parameters_of
from regkit.interchange.body_model.model_file import SUFFIXES
from regkit.interchange.body_model.smpl import MODES
from regkit.interchange.bones import THICKNESS
from regkit.interchange.imported import ImportedSkeleton
from regkit.interchange.skeletons import read_skeleton
from regkit.skeleton.joints import BallJoint
from regkit.system.errors import ConfigError, RegkitError
from regkit.system.progress import working

OPENING = """\
Made by `regkit import {command}`. To use it:
template: {{kind: file, path: {file}}}

Lengths are in metres and angles in degrees. In the rest pose all segments are parallel: y up, z to
the front, x to the body's left."""

LARGE = 10.0
"""Size [m] above which a warning suggests that the file is in centimetres."""

UNSHAPED = """\

Segments without a readable shape in the file have a capsule along each of their bones, with a
radius of {share:g} of the bone's length: set the radii to the true ones."""

UNLIMITED = """\

Ball joints have no limits in the file; set them with `swing_deg` and `twist_deg`."""

MODELLED = """\

The skin has the vertices of the model, and a joint's rotation is the model's own."""


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
    _check_given(file, modes, shape)
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
        "--modes": None if modes is None else str(modes),
    }
    written = [word for option, value in given.items() if value for word in (option, value)]
    opening = OPENING.format(command=" ".join([file.name, *written]), file=out.name)
    if imported.shaped:
        opening += "\n" + UNSHAPED.format(share=THICKNESS)
    joints = [one.joint for one in imported.description.segments.values()]
    if any(isinstance(joint, BallJoint) and joint.swing_deg is None for joint in joints):
        opening += "\n" + UNLIMITED
    if model:
        opening += "\n" + MODELLED
    write_template(
        out, imported.description, imported.skin, opening, imported.comments, imported.modes
    )
    _print_summary(imported)
    beside = [] if imported.skin is None else [skin_file(out)]
    beside += [] if imported.modes is None else [modes_file(out)]
    output.print(f"written: {' and '.join(map(str, [out, *beside]))}")
    output.print(f"template: {{kind: file, path: {out}}}")


def _check_given(file: Path, modes: int | None, shape: list[str] | None) -> None:
    """Checks that the options of body models are given for body models, and are known.

    Raises:
        ConfigError: If they are not.
        PluginError: If a shape model is unknown.
    """
    if file.suffix.lower() not in SUFFIXES:
        for option, value in (("--modes", modes), ("--shape", shape)):
            if value:
                raise ConfigError(
                    f"{file.name} is no body model ({', '.join(SUFFIXES)}), which alone has shape "
                    "modes and a surface to fit",
                    place=option,
                )
    for kind in shape or ():
        try:
            parameters_of(kind)
        except RegkitError as error:
            raise error.at(f"--shape {kind}") from None


def _print_summary(imported: ImportedSkeleton) -> None:
    """Prints a summary of the imported skeleton."""
    description = imported.description
    segments = description.segments.values()
    kinds = [segment.joint.type for segment in segments if segment.joint is not None]
    joints = ", ".join(
        f"{kinds.count(kind)} {kind}"
        for kind in ("ball", "universal", "hinge", "prismatic", "fixed")
        if kind in kinds
    )
    capsules = sum(len(segment.capsules) for segment in segments)
    skin = "" if imported.skin is None else f"skin: {len(imported.skin.vertices)} vertices; "
    if imported.modes is not None:
        skin += f"shape modes: {len(imported.modes.names)} of {imported.modes_in_file}; "
    output.print(
        f"segments: {len(kinds)} ({joints}); capsules: {capsules}; {skin}"
        f"{description.size.name}: {description.size.value:.4g} m",
    )
    if description.size.value > LARGE:
        print_warning(
            f"a {description.size.name} of {description.size.value:.4g} m is large; if the file is "
            "not in metres, give its unit, such as --scale 0.01 for centimetres"
        )
    if imported.shaped:
        output.print(
            f"segments without a shape, now with capsules along their bones: {imported.shaped}; "
            "check their radii",
        )
