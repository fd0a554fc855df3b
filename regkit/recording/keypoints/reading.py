"""Reading of keypoints, whatever their format."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from regkit.observation import Keypoints
from regkit.observation.sides import with_consistent_sides
from regkit.recording.keypoints.csv_file import read_csv_keypoints
from regkit.recording.keypoints.mediapipe import read_mediapipe
from regkit.recording.keypoints.openpose import read_openpose
from regkit.system.errors import ConfigError, DataError
from regkit.system.guard import reading
from regkit.system.notes import note

FILE = "keypoints.csv"
"""Name of the file in a recording's folder."""


def read_keypoints(path: str | Path, markers: Mapping[str, str] | None = None) -> Keypoints:
    """Returns the keypoints of a recording.

    Where a detector exchanged left and right, they are exchanged back; it is told.

    Args:
        path: A ``.csv`` file; a ``.json`` file of MediaPipe's landmarks; or the folder of
            OpenPose's JSON files.
        markers: Marker of the template for each keypoint whose name differs.

    Raises:
        ConfigError: If ``markers`` names an unknown keypoint.
        DataError: If the file is missing, of another format, or damaged, or holds no keypoint.
    """
    path = Path(path)
    with reading(path, "a file of keypoints"):
        if path.is_dir():
            found = read_openpose(path)
        elif path.suffix.lower() == ".csv":
            found = read_csv_keypoints(path)
        elif path.suffix.lower() == ".json":
            found = read_mediapipe(path)
        else:
            raise DataError(
                "keypoints are a .csv file (frame,name,x,y,confidence), a .json file of MediaPipe, "
                "or a folder of OpenPose's .json files"
            )
        if not len(found.numbers):
            raise DataError("there is no keypoint in it")
    try:
        found, exchanged = with_consistent_sides(found.renamed(markers or {}))
    except ConfigError as error:
        raise error.at(str(path)) from None
    if exchanged:
        note(
            f"left and right were exchanged in {exchanged} of {len(found.numbers)} frames, and are "
            "exchanged back",
            place=path,
        )
    return found
