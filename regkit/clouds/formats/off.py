"""Object file format (OFF) with its variants of vertices, as text.

Source: http://www.geomview.org/docs/html/OFF.html.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from regkit.clouds.formats.polygons import Polygons
from regkit.clouds.formats.text.lines import lines_of
from regkit.system.arrays import Array, Indices
from regkit.system.errors import DataError
from regkit.system.plain_numbers import real, whole
from regkit.system.printable import shortened

# Some published files have no space between OFF and the counts.
_FIRST = re.compile(r"(?P<kind>(?:ST)?C?N?4?n?)OFF\b|(?P<glued>OFF)(?=\d)")


def read_off(path: Path) -> tuple[Array, Indices]:
    """Returns the vertices (V, 3) and triangles (T, 3) of an OFF file.

    Raises:
        DataError: If a line is invalid, or the counts are not those of the file.
    """
    rows = [(number, line.partition("#")[0]) for number, line in enumerate(lines_of(path), 1)]
    rows = [(number, line.strip()) for number, line in rows if line.strip()]
    match = _FIRST.match(rows[0][1]) if rows else None
    if match is None or "4" in (match["kind"] or "") or "n" in (match["kind"] or ""):
        shown = shortened(rows[0][1]) if rows else ""
        raise DataError(
            f"the first line must be OFF, COFF, NOFF or CNOFF; it is '{shown}'", place=str(path)
        )
    rest = rows[0][1][match.end() :].strip()
    rows[:1] = [(rows[0][0], rest)] if rest else []
    if not rows:
        raise DataError("the numbers of vertices and faces are missing", place=str(path))
    number, line = rows[0]
    counts = line.split()
    if len(counts) not in (2, 3) or not all(count.isdecimal() for count in counts):
        raise DataError(
            f"'{shortened(line)}' must be the numbers of vertices, faces and edges",
            place=f"{path}:{number}",
        )
    vertices, faces = int(counts[0]), int(counts[1])
    if len(rows) - 1 != vertices + faces:
        raise DataError(
            f"announces {vertices} vertices and {faces} faces, but {len(rows) - 1} lines follow; "
            "the file is cut short or damaged",
            place=f"{path}:{number}",
        )
    points = [_vertex(*row, path) for row in rows[1 : vertices + 1]]
    corners = [_face(*row, vertices, path) for row in rows[vertices + 1 :]]
    read = np.array(points, dtype=np.float64).reshape(-1, 3)
    return read, Polygons.of(str(path), corners).triangles(read)


def _vertex(number: int, line: str, path: Path) -> list[float]:
    words = line.split()
    try:
        if len(words) >= 3:
            return [real(word) for word in words[:3]]
    except ValueError:
        pass
    raise DataError(f"not a vertex x y z: '{shortened(line)}'", place=f"{path}:{number}")


def _face(number: int, line: str, vertices: int, path: Path) -> list[int]:
    words, place = line.split(), f"{path}:{number}"
    try:
        count = whole(words[0])
        corners = [whole(word) for word in words[1 : count + 1]]
    except ValueError:
        raise DataError(f"not a face 'n i j k ...': '{shortened(line)}'", place=place) from None
    if count < 1 or len(corners) != count:
        raise DataError(f"the face announces {count} corners: '{shortened(line)}'", place=place)
    for corner in corners:
        if not 0 <= corner < vertices:
            raise DataError(
                f"the face has the vertex {corner}; there are {vertices}, from 0", place=place
            )
    return corners
