"""Wavefront OBJ: vertices and polygons.

Source: Wavefront Technologies, Object Files (.obj), Advanced Visualizer manual, appendix B1.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from regkit.clouds.formats.polygons import Polygons
from regkit.clouds.formats.text.lines import lines_of
from regkit.system.arrays import Array, Indices
from regkit.system.errors import DataError
from regkit.system.notes import note
from regkit.system.plain_numbers import real, whole

_UNREAD = ("curv", "curv2", "surf")
"""Statements of curves and surfaces that are not polygons."""


def read_obj(path: Path) -> tuple[Array, Indices]:
    """Returns the vertices (V, 3) and triangles (T, 3) of an OBJ file.

    A vertex may have a weight or a colour after x y z; a negative index counts from the last vertex
    above the face.

    Raises:
        DataError: If a vertex or a face is invalid, or a line is no statement.
    """
    vertices: list[list[float]] = []
    faces: list[list[int]] = []
    places: list[int] = []
    unread = 0
    for number, words in _statements(lines_of(path)):
        if words[0] == "v":
            vertices.append(_vertex(words, f"{path}:{number}"))
        elif words[0] in ("f", "fo"):
            faces.append(_face(words, len(vertices), f"{path}:{number}"))
            places.append(number)
        elif not words[0].isidentifier():
            raise DataError(
                f"'{' '.join(words)[:60]}' is no statement; they begin with a word such as v or f",
                place=f"{path}:{number}",
            )
        else:
            unread += words[0] in _UNREAD
    for face, number in zip(faces, places, strict=True):
        # Faces may stand above their vertices.
        if max(face) >= len(vertices):
            raise DataError(
                f"the face has the vertex {max(face) + 1}; there are {len(vertices)}, from 1",
                place=f"{path}:{number}",
            )
    if unread:
        note(f"{unread} curved surfaces are passed over; polygons are read", place=path)
    read = np.array(vertices, dtype=np.float64).reshape(-1, 3)
    return read, Polygons.of(str(path), faces).triangles(read)


def _statements(lines: list[str]) -> Iterator[tuple[int, list[str]]]:
    """Yields the words of each statement and its first line; a backslash continues a line."""
    begun, words = 0, list[str]()
    for number, line in enumerate(lines, start=1):
        text = line.partition("#")[0].rstrip()
        begun = begun if words else number
        words += text.removesuffix("\\").split()
        if words and not text.endswith("\\"):
            yield begun, words
            words = []
    if words:
        yield begun, words


def _vertex(words: list[str], place: str) -> list[float]:
    try:
        values = [real(word) for word in words[1:]]
    except ValueError:
        values = []
    if len(values) not in (3, 4, 6, 7):
        raise DataError(
            f"not a vertex 'v x y z', with a weight or a colour: '{' '.join(words)[:60]}'",
            place=place,
        )
    return values[:3]


def _face(words: list[str], vertices: int, place: str) -> list[int]:
    try:
        numbers = [whole(word.partition("/")[0]) for word in words[1:]]
    except ValueError:
        raise DataError(f"not a face: '{' '.join(words)[:60]}'", place=place) from None
    face = [number - 1 if number > 0 else vertices + number for number in numbers]
    if not face or 0 in numbers or min(face) < 0:
        raise DataError(
            f"the face has no valid vertices: '{' '.join(words)[:60]}'; they are numbered from 1, "
            f"or from -1 backwards, and {vertices} stand above",
            place=place,
        )
    return face
