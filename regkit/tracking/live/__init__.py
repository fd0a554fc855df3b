"""Tracking of cameras and recordings as their frames come.

- ``reader``: reads a stream in the background; of a camera the newest frame wins.
- ``paced``, ``limited``, ``recording_stream``: a recording at its own pace, the first frames of a
  stream, and a dataset's recording as one.
- ``watch``: what is wrong with the frames of a stream.
- ``opening``, ``beginning``: the frames in which the body is sought, and what is found in them.
- ``setup``: how a stream is tracked.
- ``latency``: quantiles of times.
- ``live_tracking``: the whole.
"""

from regkit.tracking.live.latency import Quantiles
from regkit.tracking.live.limited import LimitedStream
from regkit.tracking.live.live_tracking import LiveFrame, LiveTracking
from regkit.tracking.live.paced import PacedStream
from regkit.tracking.live.recording_stream import RecordingStream
from regkit.tracking.live.setup import OPENING, RECORDED_OPENING, LiveSetup

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
