"""The table of hinge angles that ``regkit register`` and ``regkit track`` write."""

from __future__ import annotations

from regkit.api import Tracking
from regkit.system.csv_table import csv_text


def hinge_table(tracking: Tracking) -> str:
    """Returns CSV with a row for each frame and a column ``NAME_rad`` for each hinge."""
    names = tracking.body.skeleton.hinge_names
    return csv_text(
        ("frame", *(f"{name}_rad" for name in names)),
        (
            (frame, *(f"{angle:.6f}" for angle in angles))
            for frame, angles in zip(tracking.numbers, tracking.track.hinges, strict=True)
        ),
    )
