"""Frames spread over a recording."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

import numpy as np

from regkit.interfaces import Recording
from regkit.observation import Frame
from regkit.system.errors import RegkitError


def sampled(recording: Recording, count: int) -> Iterator[Frame]:
    """Yields up to ``count`` sound frames with points, spread evenly from the first to the last.

    It ends before a damaged frame, which is reported when that frame is tracked.
    """
    indices = np.linspace(0, recording.length - 1, min(count, recording.length)).round()
    with suppress(RegkitError):
        for _, frame in recording.some(int(index) for index in indices):
            if len(frame.points) and np.isfinite(frame.points).all():
                yield frame
