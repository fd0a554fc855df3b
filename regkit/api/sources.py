"""Cameras and recordings of any format, frame by frame."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from regkit.interfaces import Source, Stream


def open_source(address: str | Path, **fields: Any) -> Stream:
    """Opens a camera or a recording, which yields frames with their time.

        with regkit.open_source("walk.mcap") as stream:
            for timed in stream:
                print(timed.time, len(timed.frame.points))

    Args:
        address: A camera, such as ``realsense:``; a bag of ROS; the recording of a camera; or a
            recording's folder.
        fields: Fields of the source, such as ``topic="/camera/depth/image_raw"``.

    Raises:
        RegkitError: If there is no such camera or file, it cannot be read, or needs a missing
            library.
    """
    return Source.at(address, **fields).open()
