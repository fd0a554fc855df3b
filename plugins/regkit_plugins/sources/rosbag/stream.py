"""The frames of a topic."""

from __future__ import annotations

from contextlib import suppress
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

from regkit.interfaces import Stream, TimedFrame
from regkit.observation import Frame
from regkit.system.errors import SourceLostError
from regkit.system.guard import foreign, reading
from regkit_plugins.sources.formats.clock import checked_time
from regkit_plugins.sources.rosbag.cameras import lens_of
from regkit_plugins.sources.rosbag.images import depth_of
from regkit_plugins.sources.rosbag.topics import DepthTopics

USUAL_FPS = 30.0
"""Frame rate of a topic with a single image [1/s]."""

TIMED = 16
"""Number of images from which the frame rate is estimated."""


class RosbagStream(Stream):
    """The depth images of a topic, in the order in which they were recorded."""

    def __init__(
        self,
        bag: Any,
        topics: DepthTopics,
        path: Path,
        *,
        depth_scale: float,
        rectified: bool | None,
    ) -> None:
        """Takes over an open bag.

        Raises:
            DataError: If the camera cannot be used.
        """
        self.name = path.name if path.is_dir() else path.stem
        self.length = sum(connection.msgcount for connection in topics.images)
        self.depth_scale = depth_scale
        self._topic = topics.name
        if rectified is None:
            rectified = self._topic.split("/")[-1].startswith("image_rect")
        with reading(f"{path}: {topics.cameras[0].topic}", "a camera"):
            self._lens = lens_of(topics.camera, rectified=rectified)
        with reading(f"{path}: {self._topic}", "a depth image"):
            self._lens.camera.check_size(depth_of(topics.first, depth_scale))
        self._path = path
        self._bag = bag
        self._images = list(topics.images)
        self.fps = self._rate()
        self._messages = bag.messages(connections=self._images)
        self._count = 0

    def read(self) -> TimedFrame | None:
        """Returns the next image; None at the end.

        Raises:
            DataError: If the image is damaged.
            SourceLostError: If the bag is damaged behind the last image.
        """
        if self._bag is None:
            return None
        place = f"{self._path}: {self._topic}: image {self._count}"
        try:
            connection, logged, data = next(self._messages)
        except StopIteration:
            return None
        except Exception as error:
            self.close()
            raise SourceLostError(
                f"the bag is damaged or cut short here: {foreign(error)}", place=place
            ) from None
        self._count += 1
        with reading(place, "an image"):
            message = self._bag.deserialize(data, connection.msgtype)
            time = checked_time(_seconds(message, logged), place=place)
            depth = depth_of(message, self.depth_scale)
            return TimedFrame(Frame.of_image(depth, self._lens, place=place), time)

    def close(self) -> None:
        """Closes the bag."""
        if self._bag is not None:
            self._bag.close()
            self._bag = None

    def _rate(self) -> float:
        """Returns the frame rate [1/s] of the first images, rounded to what clocks tell."""
        times = []
        # Reading the images tells what is damaged, and where.
        with suppress(Exception):
            messages = self._bag.messages(connections=self._images)
            for connection, logged, data in islice(messages, TIMED):
                times.append(_seconds(self._bag.deserialize(data, connection.msgtype), logged))
        steps = np.diff(times)
        steps = steps[steps > 0.0]
        return round(1.0 / float(np.median(steps)), 3) if len(steps) else USUAL_FPS


def _seconds(message: Any, logged: int) -> float:
    """Returns the time of a message's header [s]; a header without one has that of the bag."""
    stamp = message.header.stamp
    nanoseconds = int(stamp.sec) * 1_000_000_000 + int(stamp.nanosec)
    return (nanoseconds or logged) * 1e-9
