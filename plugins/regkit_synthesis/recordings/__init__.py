"""Synthetic recordings: a take defines a scene, a scene is rendered, and frames are cached."""

from regkit_synthesis.recordings.cache import RecordingCache
from regkit_synthesis.recordings.recording import DepthRecording
from regkit_synthesis.recordings.scene import FPS, SR305, SR4000, Scene
from regkit_synthesis.recordings.take import Take

__all__ = [
    "FPS",
    "SR305",
    "SR4000",
    "DepthRecording",
    "RecordingCache",
    "Scene",
    "Take",
]
