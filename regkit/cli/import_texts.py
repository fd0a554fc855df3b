"""What ``regkit import`` says of an imported skeleton, in the template and on the screen."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from regkit.cli.console import output, print_warning
from regkit.interchange.bones import THICKNESS
from regkit.interchange.imported import ImportedSkeleton
from regkit.skeleton.joints import BallJoint

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

The skin has vertices of the model, in their order, and a joint's rotation is the model's own."""


def opening_of(
    imported: ImportedSkeleton,
    file: Path,
    out: Path,
    given: Mapping[str, object],
    *,
    is_model: bool,
) -> str:
    """Returns the comment at the top of the template.

    Args:
        imported: The imported skeleton.
        file: Its file.
        out: The template's file.
        given: The options with their values, None for those that are not given.
        is_model: Whether the file holds a body model.
    """
    command = " ".join([file.name, *_words(given)])
    opening = OPENING.format(command=command, file=out.name)
    if imported.shaped:
        opening += "\n" + UNSHAPED.format(share=THICKNESS)
    joints = [one.joint for one in imported.description.segments.values()]
    if any(isinstance(joint, BallJoint) and joint.swing_deg is None for joint in joints):
        opening += "\n" + UNLIMITED
    return opening + "\n" + MODELLED if is_model else opening


def _words(given: Mapping[str, object]) -> Iterator[str]:
    for option, value in given.items():
        for one in value if isinstance(value, list) else [value]:
            if one is not None:
                yield from (option, str(one))


def print_summary(imported: ImportedSkeleton) -> None:
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
