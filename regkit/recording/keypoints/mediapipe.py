"""Keypoints of MediaPipe's pose and hand landmarkers, written to one JSON file.

MediaPipe returns objects and defines no file. The file has a list ``frames``; each has a list
``landmarks`` of objects with ``x`` and ``y``, and ``visibility`` or ``presence`` from 0 to 1, as
MediaPipe names them, and may have the number of the frame, ``frame``.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from regkit.observation import Keypoints
from regkit.recording.keypoints.detectors import detector_of
from regkit.recording.keypoints.table import KeypointTable
from regkit.system.errors import DataError
from regkit.system.json_files import read_json


def read_mediapipe(path: Path) -> Keypoints:
    """Returns the keypoints of a file, in fractions of the image.

    MediaPipe's z, relative to the hips or the wrist, is not used: it is an estimate, and the depth
    image measures.

    Raises:
        DataError: If the file is not of this form.
    """
    frames = read_json(path).get("frames")
    if not isinstance(frames, list):
        raise DataError("the field 'frames' must be a list")
    table = KeypointTable(relative=True)
    for index, frame in enumerate(frames):
        if not isinstance(frame, dict) or not isinstance(frame.get("landmarks"), list):
            raise DataError(f"frames[{index}] must be an object with a list 'landmarks'")
        number = frame.get("frame", index)
        if isinstance(number, bool) or not isinstance(number, int) or not 0 <= number < 2**31:
            raise DataError(f"frames[{index}].frame must be a whole number from 0")
        if frame["landmarks"]:
            _add(table, number, frame["landmarks"], f"frames[{index}]")
    return table.keypoints((path,))


def _add(table: KeypointTable, number: int, landmarks: list[Any], place: str) -> None:
    """Adds the keypoints of a frame.

    Raises:
        DataError: If one is not an object with numbers.
    """
    for at, (name, mark) in enumerate(
        zip(detector_of("mediapipe", len(landmarks)), landmarks, strict=True)
    ):
        values = mark if isinstance(mark, dict) else {}
        sure = values.get("visibility", values.get("presence", 1.0))
        numbers: list[Any] = [values.get("x"), values.get("y"), sure]
        if not all(isinstance(one, int | float) and not isinstance(one, bool) for one in numbers):
            raise DataError(f"{place}.landmarks[{at}] must have numbers x, y and visibility")
        x, y, sure = (float(one) for one in numbers)
        table.add(number, name, (x, y), sure)
