"""Tracking: the loop from frame to frame, and the track that comes of it."""

from regkit.tracking.loop import SUSPICIOUS, TrackedFrame, tracked
from regkit.tracking.track import Track

__all__ = ["SUSPICIOUS", "Track", "TrackedFrame", "tracked"]
