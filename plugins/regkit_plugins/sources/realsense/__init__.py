"""RealSense cameras and their recordings.

- ``camera``, ``recording``: the plug-ins.
- ``devices``: which camera is opened.
- ``stream``: the depth images of a device, connected or played back.
- ``profiles``: size, intrinsics and units of its images.
"""

from regkit_plugins.sources.realsense.camera import RealSense
from regkit_plugins.sources.realsense.recording import RealSenseRecording

__all__ = ["RealSense", "RealSenseRecording"]
