"""``regkit calibrate --extrinsics``: the poses of a recording's cameras."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from rich.markup import escape
from rich.table import Table

from regkit.calibration.extrinsics import Extrinsics, FoundCameras
from regkit.cli.choices import segmentation_named, template_named
from regkit.cli.console import output
from regkit.cli.verdicts import conclude
from regkit.interfaces import Dataset, Recording
from regkit.recording import CameraDescription, Cameras, CamerasFolder
from regkit.recording.cameras import FILE
from regkit.recording.cameras_folder import CONTENTS
from regkit.system.errors import ConfigError, DataError


def calibrate_cameras(
    folder: Path,
    template: str | None,
    out: Path | None,
    segmentation: str | None,
    frames: int | None,
    *,
    strict: bool,
) -> None:
    """Finds the poses of the cameras in a recording's folder, and writes ``cameras.json``.

    Without such a file, every folder in it with depth images or clouds is a camera.

    Args:
        folder: The recording's folder.
        template: The template, as an option gives it.
        out: The file to write; by default that in the folder.
        segmentation: The segmenters, as an option gives them.
        frames: Number of frames in which the cameras are refined.
        strict: Whether doubtful cameras count as not found.

    Raises:
        RegkitError: If the folder has no two cameras, or the body is not found in one.
        Exit: If the cameras are doubtful and ``strict`` is set.
    """
    if not folder.is_dir():
        raise DataError(
            "there is no such folder; cameras are those in the folder of a recording",
            place=str(folder),
        )
    if out is not None and out.name != FILE:
        raise ConfigError(f"the file of cameras is called {FILE}", place=f"--out {out}")
    described, each = _cameras(folder)
    if len(each) < 2:
        raise DataError(
            f"{len(each)} of its folders holds depth/ or clouds/; the poses of cameras are found "
            "from at least two",
            place=str(folder),
        )
    chosen: dict[str, Any] = {} if frames is None else {"frames": frames}
    if segmentation is not None:
        chosen["segmentation"] = segmentation_named(segmentation)
    content = CamerasFolder.of(folder, described)
    found = Extrinsics(template=template_named(template), **chosen).found(
        each,
        {camera.name: camera.times for camera in content.cameras},
        next(iter(described.cameras.values())).pose,
        place=content.name,
    )
    offsets = {
        name: round(described.cameras[name].time_offset_s + offset, 3)
        for name, offset in found.offsets.items()
    }
    to = folder if out is None else out.parent
    described.placed(found.poses, offsets).write(to)
    _print_summary(found)
    output.print(f"written: {to / FILE}")
    conclude(found.verdict, found.reason, strict=strict)


def _cameras(folder: Path) -> tuple[Cameras, Mapping[str, Recording]]:
    """Returns what is known of the cameras, and the recording of each."""
    if (folder / FILE).is_file():
        dataset = Dataset.parse(Dataset.at(folder), place=str(folder), field="dataset")
        return Cameras.read(folder), dataset.only().cameras()
    names = sorted(
        one.name
        for one in folder.iterdir()
        if any((one / content.content).is_dir() for content in CONTENTS)
    )
    each = {
        name: Dataset.parse(
            Dataset.at(folder / name), place=str(folder / name), field="dataset"
        ).only()
        for name in names
    }
    if not names:
        raise DataError(
            "none of its folders holds depth/ or clouds/; each camera of a recording has one",
            place=str(folder),
        )
    return Cameras(cameras={name: CameraDescription() for name in names}), each


def _print_summary(found: FoundCameras) -> None:
    """Prints where each camera is, and how well the body fits."""
    table = Table("camera")
    for column in ("x [m]", "y [m]", "z [m]", "markers apart [cm]", "clock [ms]"):
        table.add_column(escape(column), justify="right")
    for name, pose in found.poses.items():
        apart = f"{100.0 * found.rough[name]:.1f}" if name in found.rough else "-"
        place = [f"{value:.3f}" for value in pose[:3, 3]]
        table.add_row(escape(name), *place, apart, f"{1000.0 * found.offsets[name]:+.0f}")
    output.print(table)
    output.print(
        f"refined in {found.frames} frames; half of the data lies within "
        f"{1000.0 * found.distance:.1f} mm of the surface"
    )
