"""Pictures of bodies in depth images, to look at where there is no truth."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from regkit.body import Body
from regkit.observation import Observation
from regkit.skeleton import Pose

SIDE = 360
"""Side of a picture [px]."""

COLOURS = {
    "thumb": "#e6194b",
    "index": "#f58231",
    "middle": "#3cb44b",
    "ring": "#4363d8",
    "little": "#911eb4",
    "left": "#e6194b",
    "right": "#4363d8",
}
"""Colours of segments by the beginnings of their names; others are black."""


def drawn(
    observation: Observation,
    body: Body,
    pose: Pose,
    title: str,
    marks: Mapping[str, tuple[int, int]],
) -> NDArray[np.uint8]:
    """Returns a picture (SIDE, SIDE, 3) of the data, with the axes of the body's capsules.

    Args:
        observation: The data.
        body: The body.
        pose: Its pose.
        title: Title of the picture.
        marks: Column and row of places that are marked in the image, by the parts of the body.
    """
    assert observation.camera is not None
    assert observation.depth is not None
    columns, rows = observation.camera.projected(observation.points).T
    middle = np.array([columns.min() + columns.max(), rows.min() + rows.max()]) / 2.0
    half = 0.6 * max(np.ptp(columns), np.ptp(rows))
    box = (*(middle - half), *(middle + half))
    near, far = np.quantile(observation.points[:, 2], [0.0, 1.0])
    grey = 230.0 - 150.0 * np.clip((observation.depth - near) / (far - near + 1e-9), 0.0, 1.0)
    shown = np.where(observation.depth > 0.0, grey, 255.0).astype(np.uint8)
    picture = Image.fromarray(shown).convert("RGB")
    picture = picture.transform((SIDE, SIDE), Image.Transform.EXTENT, box)
    draw, scale = ImageDraw.Draw(picture), SIDE / (2.0 * half)
    ends = body.capsules.place(body.place(pose).transforms).ends
    for segment, pair in zip(body.capsules.segments, ends, strict=True):
        first, last = (observation.camera.projected(pair) - middle + half) * scale
        name = body.skeleton.names[segment]
        draw.line([*first, *last], fill=_colour(name), width=3)
    for name, place in marks.items():
        column, row = (np.array(place) - middle + half) * scale
        draw.ellipse([column - 5, row - 5, column + 5, row + 5], outline=_colour(name), width=2)
    draw.text((5, 5), title, fill="black")
    return np.asarray(picture)


def _colour(name: str) -> str:
    return next((colour for part, colour in COLOURS.items() if name.startswith(part)), "black")


def write_sheet(file: Path, pictures: Sequence[NDArray[np.uint8]], across: int = 4) -> None:
    """Writes pictures of equal size side by side."""
    blank = np.full_like(pictures[0], 255)
    whole = [*pictures, *[blank] * (-len(pictures) % across)]
    lines = [np.concatenate(whole[i : i + across], axis=1) for i in range(0, len(whole), across)]
    file.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray(np.concatenate(lines)).save(file)
    print(f"written: {file}")
