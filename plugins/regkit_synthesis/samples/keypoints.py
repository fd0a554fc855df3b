"""Keypoints as a detector might find them, from true joints.

``python -m regkit_synthesis.samples.keypoints FILE`` makes those of the shipped walk.
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from regkit.geometry.camera import Camera
from regkit.system.arrays import Array
from regkit_synthesis.samples.depth import human_walk

FOUND = ("shoulder", "elbow", "wrist", "hip", "knee", "ankle")
"""Joints on both sides that every detector finds, which the shipped file has."""

ALIKE = "kinect"
"""End of the names of markers that no detector finds."""


@dataclass(frozen=True)
class Detector:
    """How a synthetic detector errs.

    Attributes:
        noise: Standard deviation in space [m] or in the picture [pixels].
        spread: Standard deviation of an outlier about the middle of the body, in the same unit.
        outliers: Share of the keypoints that are outliers.
        exchanged: Share of the frames in which left and right are exchanged.
    """

    noise: float
    spread: float
    outliers: float = 0.2
    exchanged: float = 0.1


IN_SPACE, IN_PICTURE = Detector(0.025, 0.6), Detector(4.0, 40.0)
"""Detectors in space [m], and in the picture of a camera with 176 x 144 pixels."""


def write_keypoints(
    path: Path,
    joints: Iterable[str],
    positions: Array,
    random: np.random.Generator,
    camera: Camera | None = None,
) -> None:
    """Writes keypoints as a CSV file.

    Args:
        path: The file.
        joints: Names of the joints, (J,).
        positions: Their true positions in the camera frame, (T, J, 3) [m].
        random: Source of the errors.
        camera: Camera in whose picture the keypoints are; None for keypoints in space.
    """
    names, detector = list(joints), IN_SPACE if camera is None else IN_PICTURE
    header = ["frame", "name", "x", "y", *(["z"] if camera is None else []), "confidence"]
    with path.open("w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(header)
        for number, places in enumerate(positions):
            shown = places if camera is None else camera.projected(places)
            found = shown + random.normal(scale=detector.noise, size=shown.shape)
            wrong = random.random(len(found)) < detector.outliers
            spread = random.normal(scale=detector.spread, size=shown.shape)
            found[wrong] = (shown.mean(axis=0) + spread)[wrong]
            exchanged = random.random() < detector.exchanged
            for name, place in zip(names, found, strict=True):
                if not name.endswith(ALIKE):
                    told = _other_side(name) if exchanged else name
                    numbers = np.round(place, 3 if camera is None else 1)
                    rows.writerow([number, told, *numbers, round(random.uniform(0.5, 1.0), 2)])


def _other_side(name: str) -> str:
    side, _, rest = name.partition("_")
    return {"left": "right", "right": "left"}.get(side, side) + (f"_{rest}" if rest else "")


def main() -> None:
    """Makes the keypoints of the shipped walk, in the picture."""
    walk = human_walk(0)
    chosen = [walk.joints.index(f"{side}_{joint}") for joint in FOUND for side in ("left", "right")]
    write_keypoints(
        Path(sys.argv[1]),
        [walk.joints[index] for index in chosen],
        walk.truth[:, chosen],
        np.random.default_rng(0),
        walk.camera,
    )


if __name__ == "__main__":
    main()
