"""Keypoints of a recording in files of any detector.

- ``reading``: finds the format of a file or folder.
- ``csv_file``, ``openpose``, ``mediapipe``: the formats.
- ``detectors``: the detectors' names, and the markers that they are.
- ``recording``: a recording with the keypoints of another file beside it.
"""

from regkit.recording.keypoints.reading import read_keypoints

__all__ = ["read_keypoints"]
