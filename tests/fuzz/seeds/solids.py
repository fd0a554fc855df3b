"""A box as a mesh, in the formats of meshes."""

from __future__ import annotations

import json
import struct

import numpy as np

from tests.fuzz.mutations.packed import packed

BOX_VERTICES = np.array(
    [[x, y, z] for x in (0.0, 1.0) for y in (0.0, 0.9) for z in (0.0, 0.7)], dtype=float
)
BOX_FACES = np.array(
    [
        *([0, 1, 3], [0, 3, 2], [4, 7, 5], [4, 6, 7], [0, 4, 5], [0, 5, 1]),
        *([2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]),
    ]
)


def off() -> bytes:
    lines = ["OFF", f"{len(BOX_VERTICES)} {len(BOX_FACES)} 0"]
    lines += [" ".join(map(str, at)) for at in BOX_VERTICES.tolist()]
    lines += ["3 " + " ".join(map(str, face)) for face in BOX_FACES.tolist()]
    return ("\n".join(lines) + "\n").encode()


def stl_ascii() -> bytes:
    lines = ["solid box"]
    for triangle in BOX_VERTICES[BOX_FACES].tolist():
        lines += [" facet normal 0 0 1", "  outer loop"]
        lines += ["   vertex {} {} {}".format(*corner) for corner in triangle]
        lines += ["  endloop", " endfacet"]
    return ("\n".join([*lines, "endsolid box"]) + "\n").encode()


def stl_binary() -> bytes:
    triangles = b"".join(
        struct.pack("<12fH", 0, 0, 1, *triangle.ravel(), 0) for triangle in BOX_VERTICES[BOX_FACES]
    )
    return b"box".ljust(80) + struct.pack("<I", len(BOX_FACES)) + triangles


def glb() -> bytes:
    """A mesh without a skin."""
    vertices, faces = BOX_VERTICES.astype("<f4").tobytes(), BOX_FACES.astype("<u2").tobytes()
    tree = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": "box"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": len(vertices) + len(faces)}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": len(vertices)},
            {"buffer": 0, "byteOffset": len(vertices), "byteLength": len(faces)},
        ],
        "accessors": [
            {
                "bufferView": 0,
                "componentType": 5126,
                "count": len(BOX_VERTICES),
                "type": "VEC3",
                "min": [0.0, 0.0, 0.0],
                "max": [1.0, 0.9, 0.7],
            },
            {"bufferView": 1, "componentType": 5123, "count": 3 * len(BOX_FACES), "type": "SCALAR"},
        ],
    }
    return packed(json.dumps(tree).encode(), vertices + faces)
