"""A camera that measures a frame every 20 ms, without an end; for ``--plugin``."""

import time
from typing import ClassVar, Literal

import numpy as np

from regkit.config.plugin import register
from regkit.geometry import Camera, Lens
from regkit.interfaces import Source, Stream, TimedFrame
from regkit.observation import Frame
from regkit.system.errors import DataError, SourceLostError

LENS = Lens(Camera(24, 18, 20.0, 21.0, 11.3, 8.9))


@register
class SlowCamera(Source):
    """A camera that shows a plane that recedes."""

    kind: Literal["slow"] = "slow"
    scheme: ClassVar[str] = "slow"

    damaged: int = -1
    """Number of a frame that is damaged."""
    lost: int = -1
    """Number of the frame at which it is unplugged."""
    resized: int = -1
    """Number of the frame from which on it has another size."""

    @classmethod
    def fields_of(cls, address):
        return {}

    def open(self):
        return SlowStream(self)


class SlowStream(Stream):
    name = "slow"
    fps = 50.0
    live = True

    def __init__(self, camera):
        self.camera = camera
        self.number = -1

    def read(self):
        self.number += 1
        time.sleep(0.02)
        if self.number == self.camera.damaged:
            raise DataError("a frame that is torn", place="slow")
        if self.number == self.camera.lost:
            raise SourceLostError("unplugged", place="slow")
        lens = LENS
        if 0 <= self.camera.resized <= self.number:
            lens = Lens(Camera(12, 9, 10.0, 10.0, 5.5, 4.0))
        shape = (lens.camera.height, lens.camera.width)
        depth = np.full(shape, 1.0 + 0.01 * self.number)
        return TimedFrame(Frame.of_image(depth, lens), self.number / 50.0)
