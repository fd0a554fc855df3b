"""Tracking: the session, the loop from frame to frame, and the track that it records."""

from regkit.tracking.doubt import doubtful, unseen
from regkit.tracking.loop import SUSPICIOUS, TrackedFrame, tracked
from regkit.tracking.recorder import Snapshot, TrackRecorder
from regkit.tracking.session import Session
from regkit.tracking.track import Track

__all__ = [
    "SUSPICIOUS",
    "Session",
    "Snapshot",
    "Track",
    "TrackRecorder",
    "TrackedFrame",
    "doubtful",
    "tracked",
    "unseen",
]
