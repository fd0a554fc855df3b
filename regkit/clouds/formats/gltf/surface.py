"""Triangles and points of glTF 2.0 files, placed by their nodes.

Source: The Khronos Group, glTF 2.0 Specification, sections 3.5 (nodes) and 3.7 (meshes).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from regkit.clouds.formats.gltf.data import GltfData
from regkit.clouds.formats.gltf.triangles import LINES, POINTS, triangles
from regkit.geometry.rigid import transformed
from regkit.geometry.rotation import to_matrix
from regkit.system.arrays import Array, Indices
from regkit.system.errors import DataError
from regkit.system.notes import note


@dataclass
class _Surface:
    """The surface of a scene.

    Attributes:
        vertices: Vertices of the meshes placed so far, each (V, 3) [m].
        triangles: Corners of their triangles, each (T, 3).
        count: Number of vertices so far.
        skinned: Whether a mesh has a skin.
    """

    vertices: list[Array] = field(default_factory=list)
    triangles: list[Indices] = field(default_factory=list)
    count: int = 0
    skinned: bool = False


def read_gltf(path: Path) -> tuple[Array, Indices]:
    """Returns the vertices (V, 3) and triangles (T, 3) of the scene in a glTF or GLB file.

    Raises:
        DataError: If the file is damaged, compressed, or refers to data that it does not hold.
    """
    file = GltfData.load(path)
    nodes = file.model.get("nodes", [])
    surface, visited = _Surface(), set[int]()
    stack = [(root, np.eye(4)) for root in _roots(file.model, len(nodes))]
    while stack:
        at, parent = stack.pop()
        if not 0 <= at < len(nodes) or at in visited:
            raise DataError(f"node {at} is missing, or has several parents", place=str(path))
        visited.add(at)
        world = parent @ _local(nodes[at])
        if "mesh" in nodes[at]:
            # Section 3.7.3.3: the joints of a skin place its mesh, not the node.
            skinned = "skin" in nodes[at]
            surface.skinned |= skinned
            _place(file, int(nodes[at]["mesh"]), np.eye(4) if skinned else world, surface)
        stack += [(int(child), world) for child in nodes[at].get("children", [])]
    if surface.skinned:
        note("a skinned mesh is read as it was modelled, not as its joints pose it", place=path)
    vertices = np.concatenate([np.empty((0, 3)), *surface.vertices])
    return vertices, np.concatenate([np.empty((0, 3), dtype=np.intp), *surface.triangles])


def _roots(model: dict[str, Any], nodes: int) -> list[int]:
    scenes = model.get("scenes")
    if scenes:
        return [int(node) for node in scenes[model.get("scene", 0)].get("nodes", [])]
    children = {int(c) for node in model.get("nodes", []) for c in node.get("children", [])}
    return [node for node in range(nodes) if node not in children]


def _local(node: dict[str, Any]) -> Array:
    if "matrix" in node:
        return np.array(node["matrix"], dtype=np.float64).reshape(4, 4).T
    x, y, z, w = (float(value) for value in node.get("rotation", (0.0, 0.0, 0.0, 1.0)))
    transform = np.eye(4)
    scale = np.array(node.get("scale", (1.0, 1.0, 1.0)), dtype=np.float64)
    transform[:3, :3] = to_matrix(np.array([w, x, y, z])) * scale
    transform[:3, 3] = node.get("translation", (0.0, 0.0, 0.0))
    return transform


def _place(file: GltfData, mesh: int, world: Array, surface: _Surface) -> None:
    for primitive in file.item(file.model.get("meshes"), mesh, "mesh")["primitives"]:
        mode = primitive.get("mode")
        if mode in LINES:
            note(f"lines of mesh {mesh} are passed over", place=file.path)
            continue
        vertices = file.floats(primitive["attributes"]["POSITION"])
        if vertices.shape[1] != 3:
            raise file.wrong(f"positions have {vertices.shape[1]} coordinates; they need 3")
        if mode != POINTS:
            faces = triangles(file, primitive.get("indices"), mode, len(vertices))
            surface.triangles.append(faces + surface.count)
        surface.vertices.append(transformed(world, vertices))
        surface.count += len(vertices)
