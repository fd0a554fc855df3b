"""The shipped walk for tests of ``regkit track``: its template, a given start, and its poses."""

from pathlib import Path

import numpy as np
from places import DATA

WALK = DATA / "human_walk"
HUMAN = ("--template", "{kind: human, height: 1.63}")
START = (
    "--set",
    "start={kind: given, root: {position: [-0.05, -0.05, 3.25], rotation_deg: [180, 0, 0]}}",
)
FEW = ("--frames", 4)


def arrays(folder: Path) -> dict[str, np.ndarray]:
    """Returns the arrays of a tracked folder."""
    with np.load(folder / "poses.npz") as stored:
        return dict(stored)
