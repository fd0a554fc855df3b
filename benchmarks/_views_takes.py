"""Takes of a preset, seen by several cameras around the body."""

from __future__ import annotations

from typing import Any

from regkit.config.document import Document
from regkit_plugins.datasets.synthetic import Synthetic, SyntheticRecording
from regkit_plugins.presets import PEOPLE, SMMC_LIKE

PRESETS = {"people": PEOPLE, "smmc_like": SMMC_LIKE}
"""The 13 sequences that are measured, and 28 others, on which constants were chosen."""

SIZES = {"average": 1.6327, "small": 1.4901, "tall": 1.88}
"""True heights of the bodies [m]."""

TURN = 90.0
"""Angle between two cameras beside each other [deg]."""

PREPROCESSOR = {"kind": "points", "voxel": 0.03, "sigma": 0.01}
"""That of ``benchmarks/_suite.py``."""


def seen(preset: str, cameras: int, *, times: int = 1) -> list[SyntheticRecording]:
    """Returns the recordings of a preset as so many cameras see them.

    The first camera is that of the preset. The others look at the middle of the motion from as
    high, ``TURN`` degrees apart, from where the body just fills the picture.

    Args:
        preset: Name of the preset.
        cameras: Number of cameras.
        times: Factor of the frame rate.
    """
    document = Document.read(PRESETS[preset])
    data = dict(document.data)
    data["fps"] = 30.0 * times
    frames = data.get("defaults", {}).get("frames", 60)
    data["takes"] = {
        name: _seen(take, cameras, times, frames) for name, take in data["takes"].items()
    }
    dataset = Document(data, document.places).validated(Synthetic)
    return [one for one in dataset.found() if isinstance(one, SyntheticRecording)]


def _seen(take: dict[str, Any], cameras: int, times: int, frames: int) -> dict[str, Any]:
    view = take.get("view", {})
    around = {name: view[name] for name in ("elevation_deg", "roll_deg") if name in view}
    others = [
        {**around, "heading_deg": _half_turn(view.get("heading_deg", 0.0) + TURN * number)}
        for number in range(1, cameras)
    ]
    kept = {name: value for name, value in take.items() if name != "view"}
    return {**kept, "views": [view, *others], "frames": times * take.get("frames", frames)}


def _half_turn(degrees: float) -> float:
    """Returns the same angle within half a turn [deg]."""
    return (degrees + 180.0) % 360.0 - 180.0


def template_of(recording: SyntheticRecording) -> dict[str, Any]:
    """Returns the template of a recording's subject, with its true height."""
    subject = recording.subject or "average"
    return {"kind": "human", "build": subject, "height": SIZES[subject]}
