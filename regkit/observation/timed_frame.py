"""Frames with the time of their measurement."""

from __future__ import annotations

from dataclasses import dataclass

from regkit.observation.frame import Frame
from regkit.system.brief import Brief


@dataclass(frozen=True)
class TimedFrame(Brief):
    """A frame with the time of its measurement.

    Attributes:
        frame: The frame; its camera is a pinhole camera, and its depth is rectified.
        time: Time of the measurement on the source's own clock [s].
    """

    frame: Frame
    time: float
