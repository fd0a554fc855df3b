"""Stereolithography files (STL), binary and text.

Source: 3D Systems, StereoLithography Interface Specification, 1989.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from regkit.clouds.formats.text.lines import lines_of
from regkit.system.arrays import Array, Indices
from regkit.system.errors import DataError
from regkit.system.plain_numbers import real
from regkit.system.printable import shortened

_HEADER = 84
_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_FACET = ("facet", "outer", "vertex", "vertex", "vertex", "endloop", "endfacet")


def read_stl(path: Path) -> tuple[Array, Indices]:
    """Returns the corners (3 T, 3) of the triangles of an STL file, and their numbers (T, 3).

    Raises:
        DataError: If the file is cut short or damaged.
    """
    content = path.read_bytes()
    announced = int.from_bytes(content[80:_HEADER], "little")
    size = _HEADER + announced * _TRIANGLE.itemsize
    # Binary files may begin with "solid" too, but then their size fits the count.
    if len(content) >= _HEADER and len(content) == size:
        corners = np.frombuffer(content, _TRIANGLE, announced, _HEADER)["corners"]
    elif content.lstrip()[:5].lower() == b"solid" and b"\0" not in content:
        corners = _text(path)
    else:
        held = max(0, len(content) - _HEADER) / _TRIANGLE.itemsize
        raise DataError(
            f"announces {announced} triangles, but holds {held:.4g}; it is cut short, damaged, or "
            "not an STL file",
            place=str(path),
        )
    vertices = corners.reshape(-1, 3).astype(np.float64)
    return vertices, np.arange(len(vertices), dtype=np.intp).reshape(-1, 3)


def _text(path: Path) -> Array:
    corners: list[list[float]] = []
    step, inside, number = 0, False, 0
    for number, line in enumerate(lines_of(path), start=1):
        words = line.split()
        if not words:
            continue
        word, place = words[0].lower(), f"{path}:{number}"
        if step == 0 and word in ("solid", "endsolid") and inside == (word == "endsolid"):
            inside = word == "solid"
            continue
        if not inside or word != _FACET[step]:
            wanted = _FACET[step] if inside else "solid"
            raise DataError(f"'{shortened(line.strip())}' where {wanted} must stand", place=place)
        if word == "vertex":
            try:
                x, y, z = map(real, words[1:])
            except ValueError:
                raise DataError(
                    f"not a vertex x y z: '{shortened(line.strip())}'", place=place
                ) from None
            corners.append([x, y, z])
        step = (step + 1) % len(_FACET)
    if inside or step:
        raise DataError("the file ends before its endsolid", place=f"{path}:{number}")
    return np.array(corners, dtype=np.float64).reshape(-1, 3)
