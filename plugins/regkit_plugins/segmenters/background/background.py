"""The background segmenter: removes what is static."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
import scipy
from numpy.typing import NDArray
from pydantic import Field

from regkit.config.model import InputPath
from regkit.config.quantities import Count, Length, Share
from regkit.interfaces import (
    BoundSegmenter,
    Dataset,
    Expected,
    Recording,
    Segmenter,
    Template,
)
from regkit.observation import Frame
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit_plugins.segmenters.background.learned import StaticDepth
from regkit_plugins.segmenters.sampling import sampled
from regkit_plugins.segmenters.unmeasured import with_unmeasured

FEWEST = 5
"""Fewer frames than this do not show what is static."""


class Background(Segmenter):
    """Removes the static background, learned per pixel from the recording itself or an empty one.

    The camera must not move. Of the depths of a pixel over the whole recording the far ones are the
    background's: a person may hide it in most frames. Where a body stays in all but ``visible`` of
    the frames, it becomes background; then an empty recording is needed. Without an empty
    recording, a pixel that mostly has no measurement has no background, and nothing is removed.
    """

    kind: Literal["background"] = "background"

    empty: InputPath | None = None
    """Folder of a recording of the empty scene, by the same camera in the same place."""
    frames: Count = 60
    """Number of frames, spread over the recording, from which the background is learned."""
    visible: Annotated[Share, Field(gt=0.0)] = 0.1
    """Least share of the frames in which the background is visible at a pixel."""
    margin: Length = 0.03
    """Distance in front of the background within which points are removed [m], beside its noise."""

    def bind(self, recording: Recording, template: Template) -> BoundBackground:
        """Learns the background.

        Raises:
            DataError: If the frames are not depth images, or too few without an empty recording.
        """
        learned_from, visible, least = recording, self.visible, FEWEST
        if self.empty is not None:
            data = Dataset.at(self.empty)
            learned_from = Dataset.parse(data, place="background", field="empty").only()
            visible, least = 0.5, 1
        images = list(_images(learned_from, self.frames))
        if len(images) < least:
            raise DataError(
                f"{len(images)} frames do not show what is static; at least {FEWEST} do, or an "
                "empty recording (segmentation.background.empty)",
                place=recording.name,
            )
        static = StaticDepth.learned(np.array(images, dtype=np.float32), visible)
        return BoundBackground(static, self.margin)


@dataclass(frozen=True)
class BoundBackground(BoundSegmenter):
    """``Background`` bound to a recording.

    Attributes:
        static: The background.
        margin: Distance in front of it within which points are removed [m].
    """

    static: StaticDepth
    margin: float

    def segmented(self, frame: Frame, expected: Expected | None) -> Frame:
        """Returns the frame with the points in front of the background.

        Where there is a background, a pixel without a measurement is unknown.
        """
        left = frame.only(in_front(frame, self.static, self.margin))
        assert frame.depth is not None
        return with_unmeasured(left, frame.depth, np.isfinite(self.static.depth))


def in_front(frame: Frame, static: StaticDepth, margin: float) -> NDArray[np.bool_]:
    """Returns a mask (N,) of the points of a frame that are in front of the background.

    Raises:
        DataError: If the frame is not a depth image, or not of the background's size.
    """
    pixels = frame.pixels
    if pixels is None or frame.depth is None:
        raise DataError(NO_IMAGES, place=frame.place)
    if frame.depth.shape != static.depth.shape:
        raise DataError(
            f"the image is {frame.depth.shape[1]}x{frame.depth.shape[0]}, the background "
            f"{static.depth.shape[1]}x{static.depth.shape[0]}; both must be of one camera",
            place=frame.place,
        )
    # At an edge the background of a pixel is now the near and now the far side.
    nearest = scipy.ndimage.minimum_filter(static.depth - static.noise - margin, size=3)
    return np.asarray(frame.points[:, 2] < nearest.flat[pixels])


def _images(recording: Recording, count: int) -> Iterator[Array]:
    """Yields depth images of a recording, with zero for unknown pixels too.

    Raises:
        DataError: If a frame has none, or they differ in size.
    """
    shape = None
    for frame in sampled(recording, count):
        if frame.depth is None:
            raise DataError(NO_IMAGES, place=frame.place or recording.name)
        if shape not in (None, frame.depth.shape):
            raise DataError("the images differ in size", place=frame.place or recording.name)
        shape = frame.depth.shape
        yield np.nan_to_num(frame.depth, nan=0.0)


NO_IMAGES = (
    "a background is learned from depth images, and these are clouds; use the segmenters planes "
    "and pieces"
)
