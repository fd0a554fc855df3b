"""What a value can be that was read without an error; anything else is accepted nonsense.

The oracles know little, and that for certain: numbers are finite and of this world, counts are
those that the file declares, indices exist, names can be printed.
"""

from __future__ import annotations

import codecs
import re
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any
from unicodedata import category

import numpy as np

from regkit.body import Body
from regkit.geometry.skinned_mesh import SkinnedMesh
from tests.fuzz.kind import Damaged, Oracle

LARGEST = 1e12
"""No measurement is larger, in any unit of length."""
FARTHEST = 1e6
"""No model is larger [m]."""


def numbers(values: Any, what: str, *, most: float, gaps: bool = False) -> Iterator[str]:
    """Complaints about an array: NaN, infinity, or beyond ``most``."""
    array = np.asarray(values)
    if array.dtype.kind not in "fiu":
        yield f"{what}: of type {array.dtype}"
        return
    known = array[~np.isnan(array)] if gaps and array.dtype.kind == "f" else array
    if not np.isfinite(known).all():
        yield f"{what}: NaN or infinite"
    elif known.size and np.abs(known.astype(float)).max() > most:
        yield f"{what}: {np.abs(known.astype(float)).max():.3g}"


def name(text: str, what: str) -> Iterator[str]:
    if not text.strip() or any(category(letter) == "Cc" for letter in text):
        yield f"{what}: the name {text[:20]!r}"


def cloud(points: Any, file: Damaged) -> Iterator[str]:
    if points.ndim != 2 or points.shape[1] != 3 or not len(points):
        yield f"a cloud of shape {points.shape}"
    yield from numbers(points, "points", most=LARGEST)


def counted(pattern: bytes) -> Oracle:
    """A cloud has as many points as its header declares by ``pattern``."""

    def oracle(points: Any, file: Damaged) -> Iterator[str]:
        yield from cloud(points, file)
        found = re.search(pattern, file.content, re.MULTILINE)
        if not file.noted and found and int(found[1][:18]) != len(points):
            yield f"points: {len(points)} of {int(found[1][:18])} that the header declares"

    return oracle


def decoded(content: bytes) -> str:
    """The text of a file, by the mark at its start."""
    # The mark of UTF-32 begins with that of UTF-16.
    for mark, encoding in (
        (codecs.BOM_UTF32_LE, "utf-32"),
        (codecs.BOM_UTF32_BE, "utf-32"),
        (codecs.BOM_UTF16_LE, "utf-16"),
        (codecs.BOM_UTF16_BE, "utf-16"),
    ):
        if content.startswith(mark):
            return content.decode(encoding, "replace")
    return content.decode("utf-8-sig", "replace")


def lines(points: Any, file: Damaged) -> Iterator[str]:
    """A text cloud has a point for each line that is not blank, a comment or a header."""
    yield from cloud(points, file)
    text = decoded(file.content)
    rows = [
        line
        for line in re.split(r"\r\n|\r|\n", text)
        if line.strip() and line.strip()[0] not in "#/"
    ]
    if not file.noted and not len(rows) - 2 <= len(points) <= len(rows):
        yield f"points: {len(points)} of {len(rows)} lines"
    tokens = re.split(r"[\s;\"]+", text)
    written = set()
    for token in (*tokens, *re.split(r"[\s;,\"]+", text), *(t.replace(",", ".") for t in tokens)):
        # Python's own reading of a number accepts more: 1_000, and the digits of other scripts.
        # Fortran writes 1.5D+02.
        if re.fullmatch(r"[-+]?[0-9.]+([eEdD][-+]?[0-9]+)?", token):
            try:
                written.add(float(token.upper().replace("D", "E")))
            except ValueError:
                continue
    if strange := set(points.ravel().tolist()) - written:
        yield f"points: {min(strange)} is not written in the file"


def transform(matrix: Any, file: Damaged) -> Iterator[str]:
    yield from numbers(matrix, "matrix", most=LARGEST)
    turn = matrix[:3, :3]
    if not np.allclose(turn.T @ turn, np.eye(3), atol=1e-6) or np.linalg.det(turn) < 0.0:
        yield "matrix: not a rotation"
    if matrix[3].tolist() != [0.0, 0.0, 0.0, 1.0]:
        yield f"matrix: the last row is {matrix[3].tolist()}"


def body(value: Body) -> Iterator[str]:
    """A body is finite, of this world, and moves within limits that a joint has."""
    yield from numbers(value.size, "size", most=FARTHEST)
    for segment in value.skeleton.names:
        yield from name(segment, "segment")
    if len(set(value.skeleton.names)) < len(value.skeleton.names):
        yield "segments: a name twice"
    yield from every_number(value.skeleton, "skeleton")
    yield from every_number(value.capsules, "capsules")
    yield from every_number(value.markers, "markers")
    for stance in value.stances:
        yield from numbers(value.place(stance.pose).transforms, stance.name, most=FARTHEST)
        # A hinge that a stance does not name is at rest, which its limits may exclude.
        within = value.skeleton.limits.projected(stance.pose)
        bent = np.abs(stance.pose.hinges) > 0.0
        if not np.allclose(within.hinges[bent], stance.pose.hinges[bent], atol=1e-6):
            yield f"stance {stance.name}: beyond the limits of a hinge"


def every_number(value: Any, what: str) -> Iterator[str]:
    """Complaints about the arrays of reals in a dataclass; limits may be infinite."""
    for field in fields(value) if is_dataclass(value) else ():
        inner = getattr(value, field.name)
        if isinstance(inner, np.ndarray) and inner.dtype.kind == "f":
            if np.isnan(inner).any():
                yield f"{what}.{field.name}: NaN"
            elif np.abs(inner[np.isfinite(inner)]).max(initial=0.0) > FARTHEST:
                yield f"{what}.{field.name}: {np.abs(inner[np.isfinite(inner)]).max():.3g}"
        elif is_dataclass(inner):
            yield from every_number(inner, f"{what}.{field.name}")


def skin(mesh: SkinnedMesh, file: Damaged) -> Iterator[str]:
    vertices, bones = len(mesh.vertices), len(mesh.labels)
    yield from numbers(mesh.vertices, "vertices", most=FARTHEST)
    yield from numbers(mesh.rest, "rest", most=FARTHEST)
    shapes = {
        "vertices": (mesh.vertices.shape, (vertices, 3)),
        "rest": (mesh.rest.shape, (bones, 4, 4)),
        "parents": (mesh.parents.shape, (bones,)),
        "faces": (mesh.faces.shape, (len(mesh.faces), 3)),
        "weights": (mesh.weights.shape, (vertices, *mesh.indices.shape[1:])),
    }
    wrong = [f"{key}: of shape {is_}" for key, (is_, right) in shapes.items() if is_ != right]
    if wrong or not bones or not vertices:
        yield from wrong or ["no bones or vertices"]
        return
    for key, indices, end in (("faces", mesh.faces, vertices), ("indices", mesh.indices, bones)):
        if indices.size and not (indices.min() >= 0 and indices.max() < end):
            yield f"{key}: {indices.min()} to {indices.max()} of {end}"
    if not all(-1 <= parent < own for own, parent in enumerate(mesh.parents)):
        yield f"parents: {mesh.parents[:9].tolist()}"
    if (mesh.weights < 0.0).any() or not np.allclose(mesh.weights.sum(axis=1), 1.0, atol=1e-2):
        yield "weights: negative, NaN, or do not sum to one"
    if not np.allclose(mesh.rest[:, 3], [0.0, 0.0, 0.0, 1.0], atol=1e-4):
        yield "rest: a last row that is not 0 0 0 1"
    if np.abs(np.linalg.det(mesh.rest[:, :3, :3])).min() < 1e-6:
        yield "rest: a bone pose without an inverse"
    if len(set(mesh.labels)) < bones:
        yield "labels: a name twice"
    for label in mesh.labels:
        yield from name(label, "bone")
