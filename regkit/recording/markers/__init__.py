"""Positions of markers that a motion-capture system measured, in files of several formats.

- ``trajectories``: what all formats hold.
- ``trc``, ``c3d``: the formats.
- ``reading``: finds the format of a file.
"""

from regkit.recording.markers.reading import read_trajectories
from regkit.recording.markers.trajectories import Trajectories

__all__ = ["Trajectories", "read_trajectories"]
