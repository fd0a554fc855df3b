"""Keypoints of OpenPose: a folder with a JSON file for each frame."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from regkit.observation import Keypoints
from regkit.recording.keypoints.detectors import detector_of
from regkit.recording.keypoints.table import KeypointTable
from regkit.system.errors import DataError
from regkit.system.guard import reading
from regkit.system.json_files import read_json
from regkit.system.notes import note

NAME = re.compile(r"(?:^|.*_)(\d+)(_keypoints)?\.json")
"""Name of a file, with the number of its frame."""

FIELD = "pose_keypoints_2d"


def read_openpose(folder: Path) -> Keypoints:
    """Returns the keypoints of the surest person in each frame.

    Raises:
        DataError: If the folder holds no such file, or one cannot be read.
    """
    files = sorted(path for path in folder.iterdir() if path.suffix.lower() == ".json")
    if not files:
        raise DataError(
            "no file of keypoints here; OpenPose writes one like 000000000000_keypoints.json for "
            "each frame",
            place=str(folder),
        )
    table, several = KeypointTable(), 0
    numbers: dict[int, Path] = {}
    for path in files:
        with reading(path, "a JSON file of OpenPose"):
            number = _number(path)
            if number in numbers:
                raise DataError(f"{numbers[number].name} is of frame {number} too")
            numbers[number] = path
            several += _add(table, number, read_json(path))
    if several:
        note(
            f"{several} of {len(files)} frames have several people; the surest one is taken",
            place=folder,
        )
    return table.keypoints(tuple(files))


def _number(path: Path) -> int:
    """Returns the number of a file's frame.

    Raises:
        DataError: If its name has none.
    """
    match = NAME.fullmatch(path.name)
    if match is None:
        raise DataError("the name must end with the frame's number, as in 000012_keypoints.json")
    return int(match.group(1))


def _add(table: KeypointTable, number: int, content: dict[str, Any]) -> bool:
    """Adds the surest person; returns whether there are several.

    Raises:
        DataError: If the content is not that of OpenPose.
    """
    people = content.get("people")
    if not isinstance(people, list) or not all(isinstance(one, dict) for one in people):
        raise DataError("the field 'people' must be a list of objects")
    found = [_triples(one.get(FIELD)) for one in people]
    if not found:
        return False
    surest = max(found, key=lambda triples: sum(confidence for _, _, confidence in triples))
    for name, (x, y, confidence) in zip(detector_of("openpose", len(surest)), surest, strict=True):
        # OpenPose writes zeros for what it did not find.
        if confidence > 0.0:
            table.add(number, name, (x, y), confidence)
    return len(found) > 1


def _triples(values: object) -> Sequence[tuple[float, float, float]]:
    """Returns columns, rows and confidences.

    Raises:
        DataError: If the values are no numbers, three for each keypoint.
    """
    numbers = values if isinstance(values, list) else []
    plain = all(isinstance(one, int | float) and not isinstance(one, bool) for one in numbers)
    if not numbers or not plain or len(numbers) % 3:
        raise DataError(f"the field '{FIELD}' must be numbers, three for each keypoint")
    floats = [float(one) for one in numbers]
    return list(zip(floats[::3], floats[1::3], floats[2::3], strict=True))
