"""Vertices and faces of PLY files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from regkit.clouds.formats.ply.header import read_header
from regkit.clouds.formats.ply.values import BinaryValues, Column, TextValues
from regkit.clouds.formats.polygons import Polygons
from regkit.clouds.organised import OrganisedCloud
from regkit.system.arrays import Array, Indices
from regkit.system.errors import DataError
from regkit.system.notes import note

_CORNERS = ("vertex_indices", "vertex_index")
"""Names of the list of a face's corners."""


def read_ply(path: Path) -> tuple[Array, Indices]:
    """Returns the vertices (V, 3) and triangles (T, 3) of a PLY file; a cloud has no triangles.

    Raises:
        DataError: If the file is not what its header announces, or a face is invalid.
    """
    place = str(path)
    elements = _elements(path)
    vertices = _vertices(elements.get("vertex", {}), place)
    if elements.get("tristrips"):
        note("triangle strips are passed over; faces are read", place=path)
    return vertices, _polygons(elements.get("face", {}), place).triangles(vertices)


def read_organised_ply(path: Path) -> OrganisedCloud | None:
    """Returns a cloud whose file has PCL's element ``camera`` with the size of its image, or None.

    Raises:
        DataError: If the file is not what its header announces.
    """
    if not any(one.name == "camera" for one in read_header(path.read_bytes(), str(path)).elements):
        return None
    elements = _elements(path)
    size = [elements["camera"].get(name) for name in ("viewportx", "viewporty")]
    if any(not isinstance(one, np.ndarray) or one.shape != (1,) for one in size):
        return None
    width, height = (int(one[0]) for one in size if one is not None)
    vertices = _vertices(elements.get("vertex", {}), str(path))
    if min(width, height) < 2 or width * height != len(vertices):
        return None
    return OrganisedCloud(vertices.reshape(height, width, 3))


def _elements(path: Path) -> dict[str, dict[str, Column]]:
    content, place = path.read_bytes(), str(path)
    header = read_header(content, place)
    values = (
        BinaryValues(content, header.order, place, header.size)
        if header.order
        else TextValues.of(content, header, place)
    )
    # Every element is read, so that the counts of all are held against the file.
    elements = {element.name: values.read(element) for element in header.elements}
    values.check_end()
    if len(elements) < len(header.elements):
        raise DataError("the header names an element twice", place=place)
    return elements


def _vertices(columns: dict[str, Column], place: str) -> Array:
    axes = [columns.get(axis) for axis in "xyz"]
    found = [
        axis.astype(np.float64) for axis in axes if isinstance(axis, np.ndarray) and axis.ndim == 1
    ]
    if len(found) < 3:
        raise DataError(
            f"element vertex must have the properties x, y and z; it has {', '.join(columns)}",
            place=place,
        )
    return np.column_stack(found)


def _polygons(columns: dict[str, Column], place: str) -> Polygons:
    lists = next((columns[name] for name in _CORNERS if name in columns), None)
    if lists is None:
        if columns:
            note("faces without vertex_indices are passed over", place=place)
        return Polygons(place)
    polygons = Polygons(place)
    if isinstance(lists, np.ndarray):
        if lists.ndim != 2:
            raise DataError("the corners of a face must be a list", place=place)
        polygons.add(_whole(lists, place))
        return polygons
    counts = np.array([len(corners) for corners in lists])
    for count in np.unique(counts):
        group = [lists[at] for at in np.flatnonzero(counts == count)]
        polygons.add(_whole(np.array(group).reshape(len(group), count), place))
    return polygons


def _whole(corners: np.ndarray[Any, Any], place: str) -> Indices:
    if corners.dtype.kind == "f" and corners.size:
        raise DataError("the corners of a face must be whole numbers", place=place)
    return corners.astype(np.intp)
