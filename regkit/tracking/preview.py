"""What each segmenter removes from some frames of a recording."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from regkit.interfaces import Chain, Recording
from regkit.observation import Frame
from regkit.system.arrays import Indices
from regkit.system.brief import Brief


@dataclass(frozen=True)
class PreviewedFrame(Brief):
    """One frame and what is left of it.

    Attributes:
        index: Number of the frame in the recording.
        whole: The frame.
        left: The frame after all steps.
        steps: Names of the steps, (S,).
        removed_by: Index of the step that removed each point of the frame, (N,); S for a point that
            is left.
    """

    index: int
    whole: Frame
    left: Frame
    steps: tuple[str, ...]
    removed_by: Indices

    @property
    def counts(self) -> tuple[int, ...]:
        """Number of points that each step removed, and of those that are left, (S + 1,)."""
        counts = np.bincount(self.removed_by, minlength=len(self.steps) + 1)
        return tuple(int(count) for count in counts)


def previewed(recording: Recording, segmenter: Chain, count: int) -> Iterator[PreviewedFrame]:
    """Yields frames spread over a recording, segmented step by step as before the start.

    Args:
        recording: The recording.
        segmenter: Segmenters bound to it.
        count: Number of frames.

    Raises:
        RegkitError: If a frame cannot be read.
    """
    steps = tuple(segmenter.named_steps())
    indices = np.linspace(0, recording.length - 1, min(count, recording.length)).round()
    for index, whole in recording.some(int(index) for index in indices):
        removed_by = np.full(len(whole.points), len(steps))
        frame, at = whole, np.arange(len(whole.points))
        for number, (_, step) in enumerate(steps):
            frame, before = step.segmented(frame, None), frame
            kept = _kept(before, frame)
            removed_by[at[~kept]] = number
            at = at[kept]
        names = tuple(name for name, _ in steps)
        left = segmenter.segmented(whole, None)
        yield PreviewedFrame(index, whole, left, names, removed_by)


def _kept(before: Frame, after: Frame) -> NDArray[np.bool_]:
    """Returns a mask (N,) of the points of a frame that are left in another."""
    if before.views:
        left_in = {view.name: view.data for view in after.views}
        masks = [
            _kept(view.data, left_in[view.name])
            if view.name in left_in
            else np.zeros(len(view.data.points), dtype=bool)
            for view in before.views
        ]
        return np.concatenate(masks)
    if (pixels := before.pixels) is not None and (left := after.pixels) is not None:
        return np.isin(pixels, left)
    rows = {row.tobytes() for row in after.points}
    return np.array([row.tobytes() in rows for row in before.points], dtype=bool)
