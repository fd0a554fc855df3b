"""Tracking: the session, the loop from frame to frame, and the track that it records."""

from regkit.body.verdict import Verdict, check_verdicts
from regkit.tracking.extent import check_unit
from regkit.tracking.loop import Follower, TrackedFrame, tracked
from regkit.tracking.recorder import Snapshot, TrackRecorder
from regkit.tracking.session import Session
from regkit.tracking.smoothing import Smoothing, smoothed
from regkit.tracking.track import Track
from regkit.tracking.track_verdict import TrackVerdict

__all__ = [
    "Follower",
    "Session",
    "Smoothing",
    "Snapshot",
    "Track",
    "TrackRecorder",
    "TrackVerdict",
    "TrackedFrame",
    "Verdict",
    "check_unit",
    "check_verdicts",
    "smoothed",
    "tracked",
]
