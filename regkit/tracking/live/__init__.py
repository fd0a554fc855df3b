"""Tracking of cameras and recordings as their frames come.

- ``reader``: reads a stream in the background; of a camera the newest frame wins.
- ``paced``: a recording that is played at its own pace.
- ``watch``: what is wrong with the frames of a stream.
- ``opening``: the frames in which the body is sought.
- ``latency``: quantiles of times.
- ``live_tracking``: the whole.
"""

from regkit.tracking.live.latency import Quantiles
from regkit.tracking.live.live_tracking import OPENING, LiveFrame, LiveSetup, LiveTracking
from regkit.tracking.live.paced import PacedStream

__all__ = ["OPENING", "LiveFrame", "LiveSetup", "LiveTracking", "PacedStream", "Quantiles"]
