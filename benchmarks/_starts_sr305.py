"""Real hands before an SR305: fingertips against those seen in the images, and pictures.

Nobody measured the joints of these hands; in the second sequence fingertips were marked by eye.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from _starts_judge import bound, found
from _starts_options import Item, Options
from _starts_picture import drawn, write_sheet
from _starts_tips import FINGERS, TIPS
from numpy.typing import NDArray
from PIL import Image

from regkit.body import Body
from regkit.geometry.camera import Camera
from regkit.interfaces import Past, Template
from regkit.observation import Frame, Observation
from regkit.observation.crop import Crop
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.optional import one_thread
from regkit_plugins.preprocessors.points import PointsPreprocessor

DATA = Path(__file__).parents[2] / "shared" / "data" / "hand_depth_sr305_mit"

SEQUENCES = {"20210326-230536": 640, "20210326-231615": 410}
"""Number of columns from the left that hold the hand; the rest shows the person."""

MARKED = "20210326-231615"
"""The sequence with marked fingertips."""

RIGHT, WORST = 0.02, 0.04
"""A hand is right if its tips are within the first distance on average, none beyond the second,
seen in the image [m]; exchanged fingers are 2 cm apart, and a palm for a back is 8 cm off."""

CAMERA = Camera(640, 480, 476.007, 476.007, 313.683, 242.755)

UNITS = 8000.0
"""Units of the images per metre."""

OFF = 0.01
"""Data farther from the model's surface show what it misses, such as the ends of fingers [m]."""


@dataclass(frozen=True)
class Hand:
    """A real hand with the model on it.

    Attributes:
        verdict: The start's verdict; empty in a track.
        size: Length of the model [m].
        distance: Median distance of the data to the model's surface [m].
        missed: Share of the data that the model does not reach.
        tips: Distances of the fingertips in the image, (5,) [m]; None if they are not marked.
        picture: The picture.
    """

    verdict: str
    size: float
    distance: float
    missed: float
    tips: Array | None
    picture: NDArray[np.uint8]

    @classmethod
    def of(cls, file: Path, observation: Observation, body: Body, pose: Pose, verdict: str) -> Hand:
        """Returns the hand of an image with the model in a pose."""
        placement = body.place(pose)
        surface = body.capsules.place(placement.transforms)
        away = np.abs(surface.surface_distance(observation.points))
        tips, told, marks = None, "", {}
        if file.parent.name == MARKED:
            chosen = [body.markers.names.index(f"{finger}_tip") for finger in FINGERS]
            places = body.markers.place(placement.transforms)[chosen]
            gaps = CAMERA.projected(places) - TIPS[int(file.stem)]
            marks = dict(zip(FINGERS, TIPS[int(file.stem)], strict=True))
            tips = np.linalg.norm(gaps, axis=1) * places[:, 2] / CAMERA.fx
            told = f", tips {100 * tips.mean():.1f} cm"
        title = f"{file.parent.name}/{file.stem}: {verdict} {100 * body.size:.1f} cm{told}"
        return cls(
            verdict,
            body.size,
            float(np.median(away)),
            float((away > OFF).mean()),
            tips,
            drawn(observation, body, pose, title, marks),
        )

    @property
    def right(self) -> bool:
        """Returns whether the fingertips are where they are marked."""
        return self.tips is not None and self.tips.mean() < RIGHT and self.tips.max() < WORST


def _observation(file: Path) -> Observation:
    with Image.open(file) as image:
        depth = np.asarray(image).astype(np.float64) / UNITS
    depth[:, SEQUENCES[file.parent.name] :] = 0.0
    crop = Crop(behind_nearest=0.12, connected=0.02)
    prepares = PointsPreprocessor(voxel=0.006, sigma=0.004, crop=crop)
    return prepares.preprocess(Frame(CAMERA.back_projected(depth), CAMERA, depth, str(file)))


def _template() -> Template:
    return Template.parse("hand", place="benchmark", field="template")


def started(kind: str, files: tuple[Path, ...]) -> Hand:
    """Returns the fresh start in the first image; two more may show the size."""
    observations = [_observation(file) for file in files]
    with one_thread():
        start = found(kind, _template(), observations)
        result = bound(start.body).step(observations[0], Past.start(start.pose))
    return Hand.of(files[0], observations[0], start.body, result.pose, str(start.verdict))


def tracked_hand(sequence: str, template: Template) -> list[Hand]:
    """Returns the hands of a sequence, tracked with another template."""
    files = sorted((DATA / sequence).glob("*.png"), key=lambda file: int(file.stem))
    return tracked("exemplars", files, template)


def tracked(kind: str, files: list[Path], template: Template | None = None) -> list[Hand]:
    """Returns the hands of a track from the first image on."""
    observations, hands = [_observation(file) for file in files], []
    with one_thread():
        start = found(kind, template or _template(), _three(observations, 0))
        follower, past = bound(start.body), Past.start(start.pose)
        for file, observation in zip(files, observations, strict=True):
            result = follower.step(observation, past)
            past = past.followed_by(result)
            hands.append(Hand.of(file, observation, start.body, result.pose, ""))
    return hands


def _three(items: Sequence[Item], index: int) -> tuple[Item, ...]:
    """Returns an item with the two that are a third and two thirds of the list after it."""
    third = len(items) // 3
    return tuple(items[(index + step * third) % len(items)] for step in range(3))


def figures(options: Options) -> dict[str, object]:
    """Prints the table of real hands, draws them, and returns figures; none without the data."""
    if not DATA.is_dir():
        print(f"sr305 is left out: the data are not at {DATA}", file=sys.stderr)
        return {}
    heads = ("frames", "found", "right", "tips [cm]", "length [cm]", "surface [mm]", "beyond [%]")
    print(f"\n| SR305 | {' | '.join(heads)} |\n|---|{'--:|' * len(heads)}")
    shown, told = [], {}
    for sequence in SEQUENCES:
        files = sorted((DATA / sequence).glob("*.png"), key=lambda file: int(file.stem))
        triples = [_three(files, index) for index in range(len(files))]
        hands = options.mapped(sequence, partial(started, options.start), triples)
        track = tracked(options.start, files)
        for name, some in ((f"{sequence}, each afresh", hands), (f"{sequence}, tracked", track)):
            shown += [hand.picture for hand in some]
            told[name] = _row(name, some)
    write_sheet(Path("results") / "starts_sr305.png", shown)
    return {"sr305": told}


def _right(hands: list[Hand]) -> int:
    return int(sum(hand.right for hand in hands))


def _row(name: str, hands: list[Hand]) -> dict[str, object]:
    """Prints a row of the table and returns its figures."""
    sizes = [100.0 * hand.size for hand in hands]
    surface = 1000.0 * float(np.median([hand.distance for hand in hands]))
    missed = 100.0 * float(np.mean([hand.missed for hand in hands]))
    marked = [hand.tips.mean() for hand in hands if hand.tips is not None]
    cells = (
        len(hands),
        sum(hand.verdict == "found" for hand in hands) if hands[0].verdict else "-",
        _right(hands) if marked else "-",
        f"{100.0 * float(np.median(marked)):.1f}" if marked else "-",
        f"{min(sizes):.1f} to {max(sizes):.1f}",
        f"{surface:.1f}",
        f"{missed:.1f}",
    )
    print(f"| {name} | {' | '.join(map(str, cells))} |", flush=True)
    told: dict[str, object] = {
        "surface_mm": round(surface, 2),
        "beyond_1cm_percent": round(missed, 1),
    }
    if marked:
        told |= {"right": _right(hands), "of": len(hands)}
    return told
