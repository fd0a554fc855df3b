"""``regkit calibrate --base``: where a robot that stands still is, and where the cameras are."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from rich.markup import escape
from rich.table import Table

from regkit.body import BodyDescription
from regkit.body.description import ROUNDED
from regkit.body.template_file import write_template
from regkit.calibration import Shape
from regkit.calibration.base import FixedBase, FoundBase, at_base
from regkit.calibration.base.found import CameraInBase
from regkit.cli.calibration_source import Source
from regkit.cli.console import output
from regkit.cli.verdicts import conclude
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interchange.axes import body_axes
from regkit.interfaces import Recording, Template
from regkit.system.files import write_text

OPENING = """\
Made by `regkit calibrate --base` from {frames} frames of {recording}: the root stands where it was
found. To use it:
template: {{kind: file, path: {file}}}

Lengths are in metres and angles in degrees."""

NORMAL = 1.96
"""Half the width of a 95 % interval in standard deviations."""


def calibrate_base(
    source: Source,
    recording: Recording,
    out: Path,
    frames: int | None,
    axes: tuple[str, str],
    *,
    strict: bool,
) -> None:
    """Finds the base of a robot, and writes its template and the poses of the cameras.

    Args:
        source: The template, and how the data are read.
        recording: The recording.
        out: The template to write; the cameras' poses are written beside it.
        frames: Number of frames that are solved together.
        axes: The upward and the forward axis of the robot's own frame.
        strict: Whether a doubtful base counts as not found.

    Raises:
        RegkitError: If the robot is not found, or its root is fixed already.
        Exit: If the base is doubtful and ``strict`` is set.
    """
    turn = body_axes(*axes).T
    chosen: dict[str, Any] = {} if frames is None else {"frames": frames}
    found = FixedBase(
        template=source.template,
        preprocessor=source.preprocessor,
        segmentation=source.segmentation,
        start=source.start,
        **chosen,
    ).found(recording)
    cameras = {name: found.in_base(name).in_axes(turn) for name in found.cameras}
    write_at_base(source.template, found, recording.name, out)
    to = cameras_file(out)
    write_text(to, json.dumps(_record(found, cameras, recording.name, axes), indent=2) + "\n")
    _print_summary(found, cameras, axes)
    output.print(f"written: {out} and {to}")
    conclude(found.verdict, found.reason, strict=strict)


def cameras_file(out: Path) -> Path:
    """Returns the file of the cameras' poses beside a template's file."""
    return out.with_name(f"{out.stem}_cameras.json")


def write_at_base(template: Template, found: FoundBase, recording: str, out: Path) -> None:
    """Writes a template whose root stands at a base, at the size of the robot that was found."""
    text = f"Base: found in {len(found.poses)} frames of the recording {recording}"
    opening = OPENING.format(frames=len(found.poses), recording=recording, file=out.name)
    description, skin = _sized(template.description(), found.body.size)
    write_template(out, at_base(description, found.T_world_base, text), skin, opening)


def _sized(template: BodyDescription, size: float) -> tuple[BodyDescription, SkinnedMesh | None]:
    """Returns a template and its mesh at a size [m]."""
    if abs(size / template.size.value - 1.0) < ROUNDED:
        return template, None if template.mesh is None else SkinnedMesh.read(template.mesh)
    shape = Shape(template)
    proportions = shape.proportions(shape.origin(size))
    return proportions.applied(template), proportions.skin(template)


def _record(
    found: FoundBase, cameras: dict[str, CameraInBase], recording: str, axes: tuple[str, str]
) -> dict[str, Any]:
    """Returns what is written of the cameras."""
    return {
        "robot": found.body.name,
        "base": found.body.skeleton.names[0],
        "base_axes": dict(zip(("up", "front"), axes, strict=True)),
        "recording": recording,
        "frames": len(found.poses),
        "surface_distance_m": found.distance,
        "verdict": found.verdict.value,
        "reason": found.reason,
        "cameras": [
            {
                "camera": name or "camera",
                "T_base_camera": one.T_base_camera.tolist(),
                "covariance": one.covariance.tolist(),
            }
            for name, one in cameras.items()
        ],
    }


def _print_summary(
    found: FoundBase, cameras: dict[str, CameraInBase], axes: tuple[str, str]
) -> None:
    """Prints where each camera is in the base's frame, with 95 % intervals."""
    up, front = axes
    output.print(
        f"cameras in the frame of '{escape(found.body.skeleton.names[0])}' ({up} up, {front} to "
        "the front), with 95 % intervals:"
    )
    table = Table("camera")
    for column in ("position [m]", "± [mm]", "± [deg]"):
        table.add_column(escape(column), justify="right")
    for name, one in cameras.items():
        half = NORMAL * one.deviations
        place = ", ".join(f"{value:.4f}" for value in one.T_base_camera[:3, 3])
        widths = (1e3 * half[:3], np.degrees(half[3:]))
        cells = (", ".join(f"{width:.2g}" for width in part) for part in widths)
        table.add_row(escape(name or "camera"), place, *cells)
    output.print(table)
    output.print(
        f"fitted in {len(found.poses)} frames; half of the data lies within "
        f"{1000.0 * found.distance:.1f} mm of the surface"
    )
