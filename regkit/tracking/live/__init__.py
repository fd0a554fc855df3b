"""Tracking of cameras and recordings as their frames come.

- ``reader``: reads a stream in the background; of a camera the newest frame wins.
- ``paced``, ``limited``, ``recording_stream``: a recording at its own pace, the first frames of a
  stream, and a dataset's recording as one.
- ``watch``: what is wrong with the frames of a stream.
- ``opening``: the frames in which the body is sought.
- ``latency``: quantiles of times.
- ``live_tracking``: the whole.
"""

from regkit.tracking.live.latency import Quantiles
from regkit.tracking.live.limited import LimitedStream
from regkit.tracking.live.live_tracking import (
    OPENING,
    RECORDED_OPENING,
    LiveFrame,
    LiveSetup,
    LiveTracking,
)
from regkit.tracking.live.paced import PacedStream
from regkit.tracking.live.recording_stream import RecordingStream

__all__ = [
    "OPENING",
    "RECORDED_OPENING",
    "LimitedStream",
    "LiveFrame",
    "LiveSetup",
    "LiveTracking",
    "PacedStream",
    "Quantiles",
    "RecordingStream",
]
