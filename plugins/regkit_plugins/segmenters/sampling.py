"""Frames spread over a recording."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from regkit.interfaces import Recording
from regkit.observation import Frame


def sampled(recording: Recording, count: int) -> Iterator[Frame]:
    """Yields up to ``count`` frames with points, spread evenly from the first to the last.

    Raises:
        RegkitError: If a frame cannot be read.
    """
    indices = np.linspace(0, recording.length - 1, min(count, recording.length)).round()
    for _, frame in recording.some(int(index) for index in indices):
        if len(frame.points):
            yield frame
