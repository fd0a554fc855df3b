"""The table of hinge angles that ``regkit register`` and ``regkit track`` write."""

from __future__ import annotations

import csv
from io import StringIO

from regkit.api import Tracking


def hinge_table(tracking: Tracking) -> str:
    """Returns CSV with a row for each frame and a column ``NAME_rad`` for each hinge."""
    text = StringIO()
    writer = csv.writer(text, lineterminator="\n")
    names = tracking.body.skeleton.hinge_names
    writer.writerow(("frame", *(f"{name}_rad" for name in names)))
    for frame, angles in zip(tracking.indices, tracking.track.hinges, strict=True):
        writer.writerow((frame, *(f"{angle:.6f}" for angle in angles)))
    return text.getvalue()
