"""Single frames of real recordings as fresh starts: UTD-MHAD, people before a Kinect.

A start of known size has the median height of all starts of the same person without it.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from _starts_options import Options
from _starts_people import WITHIN
from _starts_sessions import experiment, single

from regkit.interfaces import Recording
from regkit.metrics.matching import matched
from regkit.observation import Truth
from regkit.system.arrays import Array
from regkit.system.errors import RegkitError
from regkit_plugins.datasets.utd_mhad import UtdMhad

DATA = Path(__file__).parents[2] / "shared" / "data" / "utd_mhad"

JOINTS: Mapping[str, str] = {
    "pelvis": "pelvis_kinect",
    "spine": "spine_kinect",
    "left_foot": "left_foot_kinect",
    "right_foot": "right_foot_kinect",
}
"""Markers of the joints that the Kinect's tracker places off the anatomical ones."""

FRAMES = 10
"""Number of frames of each recording, spread over its motion."""


@dataclass(frozen=True)
class Single:
    """A frame that was started afresh.

    Attributes:
        errors: Vectors from the markers to the reference joints, (J, 3) [m]; NaN where missing.
        rotations: ``R_world_segment`` of the markers' segments, (J, 3, 3).
        verdict: The start's verdict.
        size: Height that was found [m].
    """

    errors: Array
    rotations: Array
    verdict: str
    size: float


@dataclass(frozen=True)
class Recorded:
    """The single frames of a recording.

    Attributes:
        name: Name of the recording.
        singles: Its frames.
        refused: Number of frames without a start.
    """

    name: str
    singles: tuple[Single, ...]
    refused: int

    def raw(self) -> Array:
        """Returns the mean error of each frame (T,) [m]."""
        return np.array([_mean(one.errors) for one in self.singles])

    def adjusted(self) -> Array:
        """Returns the same less each marker's usual displacement in its segment's frame.

        Half of the frames give the displacement for the others, as a median, since some starts may
        be wrong.
        """
        local = np.array([
            np.einsum("jba,jb->ja", one.rotations, one.errors) for one in self.singles
        ])  # fmt: skip
        halves = [np.nanmedian(local[parity::2], axis=0) for parity in (1, 0)]
        usual = np.array([halves[index % 2] for index in range(len(local))])
        return np.array([_mean(errors) for errors in local - usual])

    def __str__(self) -> str:
        """Returns a row of the table."""
        raw, adjusted = self.raw(), self.adjusted()
        sizes = np.array([one.size for one in self.singles])
        doubted = sum(one.verdict != "found" for one in self.singles)
        return (
            f"| {self.name} | {100 * np.mean(raw < WITHIN):.0f} "
            f"| {100 * np.mean(adjusted < WITHIN):.0f} | {100 * np.median(raw):.1f} "
            f"| {100 * np.median(adjusted):.1f} | {sizes.min():.2f} to {sizes.max():.2f} "
            f"| {doubted} |"
        )


def _person(recording: str) -> str:
    """Returns the name of the person in a recording."""
    return recording.split("_")[1]


def _heights(rows: Sequence[Recorded]) -> dict[str, float]:
    """Returns the median height of each person over all frames [m], since nobody measured it."""
    sizes: dict[str, list[float]] = {}
    for one in rows:
        sizes.setdefault(_person(one.name), []).extend(single.size for single in one.singles)
    return {person: round(float(np.median(found)), 3) for person, found in sizes.items()}


def _mean(errors: Array) -> float:
    return float(np.nanmean(np.linalg.norm(errors, axis=1)))


def started(
    kind: str, count: int, recording: Recording, heights: Mapping[str, float] | None = None
) -> Recorded:
    """Returns fresh starts in single frames; two more frames may show an unknown size.

    Args:
        kind: Name of the search.
        count: Number of frames.
        recording: The recording.
        heights: Height of each person [m]; by default unknown.
    """
    template: dict[str, Any] = {"kind": "human"}
    if heights is not None:
        template["height"] = heights[_person(recording.name)]
    chosen = experiment(kind, template, {"kind": "utd_mhad", "root": str(DATA)})
    spread = np.linspace(0.1, 0.9, count) * (recording.length - 1)
    wanted = [int(index) for index in spread]
    frames = [frame for _, frame in recording.some(wanted)]
    truth, singles = recording.truth(), []
    assert truth is not None
    third = max(1, count // 3)
    for number, index in enumerate(wanted):
        three = [frames[(number + step * third) % count] for step in range(3)]
        try:
            start, found = single(chosen, three)
        except RegkitError:
            continue
        body, joints = start.body, Truth(truth.joints, truth.positions[index : index + 1])
        columns, markers = matched(body, joints, JOINTS)
        transforms = body.place(found.registered.pose).transforms
        errors = joints.positions[0, columns] - body.markers.place(transforms)[markers]
        rotations = transforms[body.markers.segments[markers], :3, :3]
        singles.append(Single(errors, rotations, str(start.verdict), body.size))
    return Recorded(recording.name, tuple(singles), count - len(singles))


def figures(options: Options) -> dict[str, object]:
    """Prints the table of real recordings, and returns its figures; none without the data."""
    if not DATA.is_dir():
        print(f"utd is left out: the data are not at {DATA}", file=sys.stderr)
        return {}
    recordings = UtdMhad(root=DATA).chosen()
    count = min(FRAMES, max(4, options.some // len(recordings)))
    unknown = options.mapped("UTD-MHAD", partial(started, options.start, count), recordings)
    heights = _heights(unknown)
    sized = partial(started, options.start, count, heights=heights)
    known = options.mapped("UTD-MHAD, known size", sized, recordings)
    found: dict[str, object] = {"frames": count * len(recordings), "heights_m": heights}
    for name, rows in (("unknown", unknown), ("known", known)):
        _print(f"UTD-MHAD, {count} frames, size {name}", rows)
        total = count * len(rows)
        within = _percent(sum((one.raw() < WITHIN).sum() for one in rows), total)
        adjusted = _percent(sum((one.adjusted() < WITHIN).sum() for one in rows), total)
        found[f"{name}_size_within_10cm_percent"] = within
        found[f"{name}_size_within_10cm_adjusted_percent"] = adjusted
    return {"utd": found}


def _print(title: str, rows: Sequence[Recorded]) -> None:
    """Prints a table of recordings."""
    heads = ("within 10 cm [%]", "adjusted [%]", "median [cm]", "adjusted [cm]", "height [m]")
    print(f"\n| {title} | {' | '.join(heads)} | not found or doubtful |")
    print("|---|" + "--:|" * (len(heads) + 1))
    print("\n".join(map(str, rows)), flush=True)


def _percent(part: int, total: int) -> float:
    return round(100.0 * float(part) / total, 1)
