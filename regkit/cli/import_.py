"""``regkit import``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from regkit.cli.console import output
from regkit.cli.options import options
from regkit.cli.template_file import check_replaceable, write_template
from regkit.interchange.imported import THICKNESS, ImportedSkeleton
from regkit.interchange.skeletons import read_skeleton
from regkit.skeleton.joints import BallJoint
from regkit.system.errors import ConfigError

OPENING = """\
What `regkit import {command}` made. To use it:
template: {{kind: file, path: {file}}}

Lengths are in metres and angles in degrees. In the rest pose all segments are parallel: y up, z to
the front, x to the body's left."""

LARGE = 10.0
"""Bodies larger than this [m] are more often centimetres that were taken for metres."""

UNSHAPED = """\

Where the file has no shape that could be read, a segment has a capsule along each of its bones,
whose radius is {share:g} of the bone's length: make them what they are."""

UNLIMITED = """\

Ball joints have no limits in the file; `swing_deg` and `twist_deg` give them some."""


def import_(
    file: Annotated[
        Path,
        typer.Argument(metavar="FILE", help="A .bvh or .urdf file.", show_default=False),
    ],
    out: Annotated[Path, typer.Option(metavar="FILE", help="The template to write.")] = Path(
        "imported.yaml"
    ),
    scale: Annotated[
        float, typer.Option(help="Metres per unit of the file: 0.01 for centimetres.")
    ] = 1.0,
    title: Annotated[
        str | None,
        typer.Option(
            "--name",
            metavar="TEXT",
            help="What it is, in a line; the file's name without it.",
            show_default=False,
        ),
    ] = None,
    up: Annotated[
        str | None,
        typer.Option(
            metavar="AXIS",
            help="The file's axis that points up, such as y or -z; by custom y of BVH, z of URDF.",
            show_default=False,
        ),
    ] = None,
    front: Annotated[
        str | None,
        typer.Option(
            metavar="AXIS",
            help="The one that points to the front; by custom z of BVH, x of URDF.",
            show_default=False,
        ),
    ] = None,
) -> None:
    """Make a template of another program's skeleton: BVH, or URDF with its limits."""
    if not 0.0 < scale < float("inf"):
        raise ConfigError(f"{scale:g} is no scale; it must be positive", place="--scale")
    check_replaceable(out)
    with options(up="--up", front="--front"):
        imported = read_skeleton(file, scale=scale, title=title, up=up, front=front)
    given = {"--scale": f"{scale:g}" if scale != 1.0 else None, "--up": up, "--front": front}
    written = [word for option, value in given.items() if value for word in (option, value)]
    opening = OPENING.format(command=" ".join([file.name, *written]), file=out.name)
    if imported.shaped:
        opening += "\n" + UNSHAPED.format(share=THICKNESS)
    if any(isinstance(one.joint, BallJoint) for one in imported.description.segments.values()):
        opening += "\n" + UNLIMITED
    write_template(out, imported.description, None, opening, imported.comments)
    _tell(imported)
    output.print(f"written: {out}", highlight=False, soft_wrap=True)
    output.print(f"template: {{kind: file, path: {out}}}", highlight=False, soft_wrap=True)


def _tell(imported: ImportedSkeleton) -> None:
    """Print what was read."""
    description = imported.description
    segments = description.segments.values()
    kinds = [segment.joint.type for segment in segments if segment.joint is not None]
    joints = ", ".join(
        f"{kinds.count(kind)} {kind}"
        for kind in ("ball", "universal", "hinge", "fixed")
        if kind in kinds
    )
    capsules = sum(len(segment.capsules) for segment in segments)
    output.print(
        f"segments: {len(kinds)} ({joints}); capsules: {capsules}; "
        f"{description.size.name}: {description.size.value:.4g} m",
        highlight=False,
        markup=False,
        soft_wrap=True,
    )
    if description.size.value > LARGE:
        output.print(
            "that is large; if the file is not in metres, name its unit: --scale 0.01 for "
            "centimetres",
            highlight=False,
            markup=False,
            soft_wrap=True,
        )
    if imported.shaped:
        output.print(
            f"segments that had no shape and got one along their bones: {imported.shaped}; look at "
            "them",
            highlight=False,
            markup=False,
            soft_wrap=True,
        )
