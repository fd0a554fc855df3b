"""Export of an animated skinned mesh as glTF.

Source: The Khronos Group, glTF 2.0 Specification, sections 3.7.3 (skins) and 3.11 (animations).
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from regkit import __version__
from regkit.geometry.rigid import inverse
from regkit.geometry.rotation import from_matrix
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.geometry.surface import vertex_normals
from regkit.interchange.gltf.buffer import GltfBuffer
from regkit.interchange.gltf.file import pygltflib
from regkit.system.arrays import Array
from regkit.system.files import replacing

CLAY = (0.75, 0.68, 0.6, 1.0)
"""Colour of the material."""

STILL = 1e-7
"""A bone that translates less than this relative to its parent gets no translation channel [m]."""

_CARRIERS = 4
"""Number of bones in one set of skinning attributes."""


def write_gltf(
    path: Path, mesh: SkinnedMesh, poses: Array, fps: float, name: str, rotation: Array
) -> None:
    """Writes a mesh and the motion of its bones as a ``.glb`` file.

    The root node rotates the scene to y up. The nodes of the bones have the pose of the first
    frame.

    Args:
        path: The file.
        mesh: The mesh; without triangles its vertices are displayed as points.
        poses: ``T_world_bone``, (T, J, 4, 4) [m].
        fps: Frames per second.
        name: Name of the motion.
        rotation: ``R_scene_world``, (3, 3).

    Raises:
        DataError: If the file cannot be written.
        DependencyError: If pygltflib is missing.
    """
    gltf = pygltflib()
    packed = GltfBuffer(gltf)
    bones = len(mesh.labels)
    first, body = 1, 1 + bones
    relative = _in_parents(mesh, poses)
    rotations, translations = _steady(from_matrix(relative[..., :3, :3])), relative[..., :3, 3]
    children: list[list[int]] = [[] for _ in range(bones)]
    for bone, parent in enumerate(mesh.parents):
        if parent >= 0:
            children[parent].append(first + bone)
    roots = [first + bone for bone in range(bones) if mesh.parents[bone] < 0]
    nodes = [
        gltf.Node(name="y up", rotation=from_matrix(rotation).tolist(), children=[*roots, body]),
        *(
            gltf.Node(
                name=label,
                translation=translations[0, bone].tolist(),
                rotation=rotations[0, bone].tolist(),
                children=children[bone],
            )
            for bone, label in enumerate(mesh.labels)
        ),
        gltf.Node(name=name, mesh=0, skin=0),
    ]
    times = packed.add(np.arange(len(poses), dtype=np.float64)[:, None] / fps, "<f4", bounds=True)
    animation = gltf.Animation(name=name)
    for bone in range(bones):
        moves = {"rotation": rotations[:, bone]}
        if np.ptp(translations[:, bone], axis=0).max() > STILL:
            moves["translation"] = translations[:, bone]
        for what, values in moves.items():
            target = gltf.AnimationChannelTarget(node=first + bone, path=what)
            sampler = len(animation.samplers)
            animation.channels.append(gltf.AnimationChannel(sampler=sampler, target=target))
            output = packed.add(values, "<f4")
            animation.samplers.append(gltf.AnimationSampler(input=times, output=output))
    binds = packed.add(np.linalg.inv(mesh.rest).swapaxes(1, 2).reshape(-1, 16), "<f4")
    skin = gltf.Skin(inverseBindMatrices=binds, joints=list(range(first, body)), name=name)
    model = gltf.GLTF2(
        asset=gltf.Asset(version="2.0", generator=f"regkit {__version__}"),
        scene=0,
        scenes=[gltf.Scene(nodes=[0])],
        nodes=nodes,
        meshes=[gltf.Mesh(name=name, primitives=[_primitive(gltf, mesh, packed)])],
        materials=[_material(gltf)],
        skins=[skin],
        animations=[animation],
        accessors=packed.accessors,
        bufferViews=packed.views,
        buffers=[gltf.Buffer(byteLength=len(packed.content))],
    )
    model.set_binary_blob(bytes(packed.content))
    with replacing(path) as temporary:
        temporary.write_bytes(b"".join(model.save_to_bytes()))


def _in_parents(mesh: SkinnedMesh, poses: Array) -> Array:
    """Returns ``T_parent_bone`` of every bone in every frame, (T, J, 4, 4)."""
    relative = poses.copy()
    for bone, parent in enumerate(mesh.parents):
        if parent >= 0:
            relative[:, bone] = inverse(poses[:, parent]) @ poses[:, bone]
    return relative


def _steady(quaternions: Array) -> Array:
    """Returns the quaternions (T, J, 4) with signs that are continuous over time."""
    steady = quaternions.copy()
    for frame in range(1, len(steady)):
        against = (steady[frame] * steady[frame - 1]).sum(axis=1) < 0.0
        steady[frame, against] *= -1.0
    return steady


def _primitive(gltf: Any, mesh: SkinnedMesh, packed: GltfBuffer) -> Any:
    attributes = gltf.Attributes(POSITION=packed.add(mesh.vertices, "<f4", bounds=True))
    indices, mode = None, 0
    if len(mesh.faces):
        normals = vertex_normals(mesh.vertices, mesh.faces)
        # A vertex without a triangle has a zero normal, but the format requires unit vectors.
        normals[~normals.any(axis=1)] = [0.0, 1.0, 0.0]
        attributes.NORMAL = packed.add(normals, "<f4")
        indices, mode = packed.add(mesh.faces.reshape(-1, 1), "<u4"), 4
    missing = -mesh.indices.shape[1] % _CARRIERS
    carriers = np.pad(np.where(mesh.weights > 0.0, mesh.indices, 0), ((0, 0), (0, missing)))
    weights = np.pad(mesh.weights, ((0, 0), (0, missing)))
    weights /= weights.sum(axis=1, keepdims=True)
    for number in range(carriers.shape[1] // _CARRIERS):
        own = slice(number * _CARRIERS, (number + 1) * _CARRIERS)
        setattr(attributes, f"JOINTS_{number}", packed.add(carriers[:, own], "<u2"))
        setattr(attributes, f"WEIGHTS_{number}", packed.add(weights[:, own], "<f4"))
    return gltf.Primitive(attributes=attributes, indices=indices, mode=mode, material=0)


def _material(gltf: Any) -> Any:
    matt = gltf.PbrMetallicRoughness(
        baseColorFactor=list(CLAY), metallicFactor=0.0, roughnessFactor=0.8
    )
    return gltf.Material(name="clay", pbrMetallicRoughness=matt, doubleSided=True)
