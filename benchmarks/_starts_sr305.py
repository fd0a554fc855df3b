"""Real hands before an SR305, whose joints nobody knows: a picture to look at, and distances."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from _starts_judge import bound, found
from _starts_options import Options
from _starts_picture import drawn, write_sheet
from numpy.typing import NDArray
from PIL import Image

from regkit.geometry.camera import Camera
from regkit.interfaces import Past, Template
from regkit.observation import Frame
from regkit.observation.crop import Crop
from regkit.system.optional import one_thread
from regkit_plugins.preprocessors.points import PointsPreprocessor

DATA = Path(__file__).parents[2] / "shared" / "data" / "hand_depth_sr305_mit"

SEQUENCES = {"20210326-230536": 640, "20210326-231615": 410}
"""Number of columns from the left that hold the hand; the rest shows the person."""

CAMERA = Camera(640, 480, 476.007, 476.007, 313.683, 242.755)

UNITS = 8000.0
"""Units of the images per metre."""

OFF = 0.01
"""Data farther from the model's surface show what it misses, such as the ends of fingers [m]."""


@dataclass(frozen=True)
class Hand:
    """A real hand with the model on it.

    Attributes:
        verdict: The start's verdict.
        size: Length that was found [m].
        distance: Median distance of the data to the model's surface [m].
        missed: Share of the data that the model does not reach.
        picture: The picture.
    """

    verdict: str
    size: float
    distance: float
    missed: float
    picture: NDArray[np.uint8]


def started(kind: str, files: tuple[Path, Path, Path]) -> Hand:
    """Returns the fresh start in the first image; two more may show the size."""
    crop = Crop(behind_nearest=0.12, connected=0.02)
    prepares = PointsPreprocessor(voxel=0.006, sigma=0.004, crop=crop)
    observations = [prepares.preprocess(_frame(file)) for file in files]
    template = Template.parse("hand", place="benchmark", field="template")
    with one_thread():
        start = found(kind, template, observations)
        result = bound(start.body).step(observations[0], Past.start(start.pose))
    placed = start.body.capsules.place(start.body.place(result.pose).transforms)
    away = np.abs(placed.surface_distance(observations[0].points))
    title = (
        f"{files[0].parent.name}/{files[0].stem}: {start.verdict}, {100 * start.body.size:.1f} cm"
    )
    return Hand(
        str(start.verdict),
        start.body.size,
        float(np.median(away)),
        float((away > OFF).mean()),
        drawn(observations[0], start.body, result.pose, title),
    )


def _frame(file: Path) -> Frame:
    with Image.open(file) as image:
        depth = np.asarray(image).astype(np.float64) / UNITS
    depth[:, SEQUENCES[file.parent.name] :] = 0.0
    return Frame(CAMERA.back_projected(depth), CAMERA, depth, str(file))


def figures(options: Options) -> dict[str, object]:
    """Prints the table of real hands, draws them, and returns distances; none without the data."""
    if not DATA.is_dir():
        print(f"sr305 is left out: the data are not at {DATA}", file=sys.stderr)
        return {}
    print("\n| SR305 | frames | found | length [cm] | surface [mm] | beyond 1 cm [%] |")
    print("|---|--:|--:|--:|--:|--:|")
    shown, told = [], {}
    for sequence in SEQUENCES:
        files = sorted((DATA / sequence).glob("*.png"), key=lambda file: int(file.stem))
        third = len(files) // 3
        triples = [
            (file, files[(index + third) % len(files)], files[(index + 2 * third) % len(files)])
            for index, file in enumerate(files)
        ]
        hands = options.mapped(sequence, partial(started, options.start), triples)
        shown += [hand.picture for hand in hands]
        sizes = [100.0 * hand.size for hand in hands]
        surface = 1000.0 * float(np.median([hand.distance for hand in hands]))
        missed = 100.0 * float(np.mean([hand.missed for hand in hands]))
        count = sum(hand.verdict == "found" for hand in hands)
        print(
            f"| {sequence} | {len(hands)} | {count} | {min(sizes):.1f} to {max(sizes):.1f} "
            f"| {surface:.1f} | {missed:.1f} |",
            flush=True,
        )
        told[sequence] = {"surface_mm": round(surface, 2), "beyond_1cm_percent": round(missed, 1)}
    write_sheet(Path("results") / "starts_sr305.png", shown)
    return {"sr305": told}
