"""Skinned meshes: npz, glTF with its data inside or beside it, GLB."""

from __future__ import annotations

import base64
import io
import json
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from regkit.geometry.skinned_mesh import KEYS, SkinnedMesh
from regkit.interchange.meshes import read_mesh
from regkit.testing.samples import linkage
from regkit_synthesis.figure.figure import FIGURE
from regkit_synthesis.figure.standing import STANDING
from tests.fuzz import oracles
from tests.fuzz.kind import Files, Kind
from tests.fuzz.mutations.packed import packed

BONES = ("hips", "spine", "head")


def arrays() -> dict[str, np.ndarray]:
    """The skin of the sample linkage, as the arrays of a mesh file."""
    body = linkage()
    assert body.surface is not None
    skeleton = body.skeleton
    rest = body.place(skeleton.rest()).transforms
    vertices = np.array(
        [[0.1 * x, 0.3 * y, 0.05 * (x * y % 3)] for y in range(6) for x in range(4)]
    )
    faces = np.array(
        [[r * 4 + c, r * 4 + c + 1, r * 4 + c + 4] for r in range(5) for c in range(3)]
    )
    indices = np.array([[n % len(rest), (n + 1) % len(rest)] for n in range(len(vertices))])
    values = (
        vertices.astype(np.float32),
        faces.astype(np.uint32),
        np.array(skeleton.names),
        np.array(skeleton.parents),
        rest.astype(np.float32),
        indices.astype(np.uint16),
        np.full(indices.shape, 0.5, dtype=np.float32),
    )
    return dict(zip(KEYS, values, strict=True))


def npz() -> list[Files]:
    stream = io.BytesIO()
    np.savez_compressed(stream, **arrays())
    return [{"mesh.npz": stream.getvalue()}]


@lru_cache
def rigged(names: tuple[str, ...] = BONES) -> tuple[dict[str, Any], bytes]:
    """The tree and the data of a rigged and animated glTF body.

    Args:
        names: Three bones in a chain, or all joints of the human figure.
    """
    human = names != BONES
    parents = [
        names.index(FIGURE[one]) if human and FIGURE[one] else n - 1 for n, one in enumerate(names)
    ]
    parents[0] = -1
    places = [STANDING[one] if human else np.array([0, 0.6 * n, 0]) for n, one in enumerate(names)]
    data, views, accessors = b"", [], []

    def add(values: np.ndarray, kind: int, form: str) -> int:
        nonlocal data
        content = np.ascontiguousarray(values).tobytes()
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(content)})
        data += content + bytes(-len(content) % 4)
        accessor = {"bufferView": len(views) - 1, "componentType": kind, "count": len(values)}
        if form in ("VEC3", "SCALAR"):
            ends = (np.atleast_1d(end).tolist() for end in (values.min(0), values.max(0)))
            accessor |= dict(zip(("min", "max"), ends, strict=True))
        accessors.append({**accessor, "type": form})
        return len(accessors) - 1

    vertices = np.repeat(np.array(places, dtype="<f4"), 4, axis=0)
    vertices += np.tile([[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0], [0, 0, 0.1]], (len(names), 1))
    joints = np.zeros((len(vertices), 4), dtype="<u2")
    joints[:, 0] = np.arange(len(vertices)) // 4
    weights = np.tile(np.array([0.75, 0.25, 0, 0], dtype="<f4"), (len(vertices), 1))
    faces = np.array([[n, n + 1, n + 2] for n in range(len(vertices) - 2)], dtype="<u2")
    binds = np.tile(np.eye(4, dtype="<f4"), (len(names), 1, 1))
    binds[:, 3, :3] = -np.array(places)
    turns = np.tile(np.array([0, 0, 0, 1], dtype="<f4"), (3, 1))
    turns[2] = [0.6, 0, 0, 0.8]
    attributes = {
        "POSITION": add(vertices.astype("<f4"), 5126, "VEC3"),
        "JOINTS_0": add(joints, 5123, "VEC4"),
        "WEIGHTS_0": add(weights, 5126, "VEC4"),
    }
    index = add(faces.ravel(), 5123, "SCALAR")
    bind = add(binds.reshape(-1, 16), 5126, "MAT4")
    times = add(np.array([0.0, 0.5, 1.0], dtype="<f4"), 5126, "SCALAR")
    turn = add(turns, 5126, "VEC4")
    nodes = [
        {
            "name": one,
            "children": [child for child, parent in enumerate(parents) if parent == n],
            "translation": (places[n] - (places[parents[n]] if n else 0.0)).tolist(),
        }
        for n, one in enumerate(names)
    ]
    channels = [{"sampler": 0, "target": {"node": 1, "path": "rotation"}}]
    sampler = {"input": times, "output": turn, "interpolation": "LINEAR"}
    tree = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0, len(names)]}],
        "nodes": [*nodes, {"name": "body", "mesh": 0, "skin": 0}],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": index}]}],
        "skins": [{"joints": list(range(len(names))), "inverseBindMatrices": bind}],
        "animations": [{"name": "nod", "channels": channels, "samplers": [sampler]}],
        "buffers": [{"byteLength": len(data)}],
        "bufferViews": views,
        "accessors": accessors,
    }
    return tree, data


def glb(names: tuple[str, ...] = BONES) -> list[Files]:
    tree, data = rigged(names)
    return [{"mesh.glb": packed(json.dumps(tree).encode(), data)}]


def gltf() -> list[Files]:
    tree, data = rigged()
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    inside = {**tree, "buffers": [{"byteLength": len(data), "uri": uri}]}
    beside = {**tree, "buffers": [{"byteLength": len(data), "uri": "data.bin"}]}
    return [
        {"mesh.gltf": json.dumps(inside).encode()},
        {"mesh.gltf": json.dumps(beside).encode(), "data.bin": data},
    ]


def _read(path: Path) -> SkinnedMesh:
    return read_mesh(path)


MESHES = (
    Kind(
        "meshes/npz",
        npz,
        {"mesh.npz": "npz"},
        _read,
        oracles.skin,
        suffixes=(".glb", ".gltf"),
        weight=4.0,
    ),
    Kind(
        "meshes/glb",
        glb,
        {"mesh.glb": "glb"},
        _read,
        oracles.skin,
        suffixes=(".gltf", ".npz"),
        weight=4.0,
    ),
    Kind(
        "meshes/gltf",
        gltf,
        {"mesh.gltf": "json"},
        _read,
        oracles.skin,
        suffixes=(".glb",),
        weight=3.0,
    ),
)
