"""Keypoints from files of any detector."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from regkit.observation import Keypoints
from regkit.recording.keypoints import read_keypoints


def load_keypoints(path: str | Path, markers: Mapping[str, str] | None = None) -> Keypoints:
    """Returns the keypoints of a recording.

    Where a detector exchanged left and right, they are exchanged back; it is told.

    Args:
        path: A ``.csv`` file with the header ``frame,name,x,y,confidence`` [pixels] or
            ``frame,name,x,y,z,confidence`` [m]; a ``.json`` file of MediaPipe's landmarks; or the
            folder of OpenPose's JSON files.
        markers: Marker of the template for each keypoint whose name differs and is not that of a
            known detector.

    Raises:
        RegkitError: If the file is missing or damaged, or ``markers`` names an unknown keypoint.
    """
    return read_keypoints(path, markers)
