"""Segmentation of one frame, of which something must be left."""

from __future__ import annotations

from regkit.interfaces import BoundSegmenter, Expected
from regkit.observation import Frame
from regkit.system.arrays import checked_points
from regkit.system.errors import NoBodyError


def segmented(segmenter: BoundSegmenter, frame: Frame, expected: Expected | None) -> Frame:
    """Returns what a segmenter leaves of a frame.

    Raises:
        DataError: If a coordinate is not finite.
        NoBodyError: If it leaves no point of a frame that has some.
    """
    checked_points(frame.points, place=frame.place)
    left = segmenter.segmented(frame, expected)
    if len(frame.points) and not len(left.points):
        raise NoBodyError(
            f"none of the frame's {len(frame.points)} points may be the body's (segmentation; "
            "regkit preview shows what is removed)",
            place=frame.place,
        )
    return left
