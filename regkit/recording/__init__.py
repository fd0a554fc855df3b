"""The folder format of recordings, common to depth images and clouds, read and written.

my_recording/
sequence.yaml      name, fps, depth_scale, source, licence
camera.json        intrinsics and lens distortion (depth images)
depth/000000.png   or clouds/000000.ply; numbered without gaps
times.csv          optional: frame,time_s
truth.csv          optional: frame,joint,x,y,z [m] in the camera's frame
keypoints.csv      optional: frame,name,x,y,confidence [pixels], or with z [m]

Several cameras have a folder each, in that of a ``cameras.json`` with their poses.

- ``description``: ``sequence.yaml``.
- ``folder``: the folder of one recording; ``search`` finds those below a root.
- ``depth_folder``, ``cloud_folder``: its frames.
- ``keypoints``: ``keypoints.csv``, and the files of detectors.
- ``times``: ``times.csv``.
- ``cameras``, ``cameras_folder``: ``cameras.json``, and the folder of several cameras.
- ``instants``: which of their frames belong together.
- ``writer``, ``png``: writes it, frame by frame.
"""

from regkit.recording.cameras import CameraDescription, Cameras
from regkit.recording.cameras_folder import CamerasFolder
from regkit.recording.cloud_folder import CloudFolder
from regkit.recording.depth_folder import DepthFolder
from regkit.recording.description import RecordingDescription
from regkit.recording.folder import RecordingFolder
from regkit.recording.writer import FolderWriter

__all__ = [
    "CameraDescription",
    "Cameras",
    "CamerasFolder",
    "CloudFolder",
    "DepthFolder",
    "FolderWriter",
    "RecordingDescription",
    "RecordingFolder",
]
