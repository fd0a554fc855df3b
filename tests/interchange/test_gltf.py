"""Rigged glTF bodies: their vertices are where the format's own formula puts them."""

import base64
import json
import struct
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

from regkit.geometry.rigid import rigid
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interchange.gltf import webxr_hand
from regkit.interchange.gltf.gltf import RiggedBody
from regkit.interchange.gltf.motion import write_gltf
from regkit.system.errors import DataError

KINDS = {5121: "<u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}


class Plainly:
    """A .glb file read with nothing but the specification at hand, to compare with."""

    def __init__(self, path: Path) -> None:
        content = path.read_bytes()
        (length,) = struct.unpack("<I", content[12:16])
        self.json = json.loads(content[20 : 20 + length])
        self.binary = content[28 + length :]
        nodes = self.json["nodes"]
        self.parents = {c: p for p, node in enumerate(nodes) for c in node.get("children", [])}
        (self.skin,) = self.json["skins"]

    def numbers(self, index: int) -> np.ndarray:
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        kind, width = np.dtype(KINDS[accessor["componentType"]]), WIDTHS[accessor["type"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        step = view.get("byteStride", kind.itemsize * width)
        return np.array(
            [
                np.frombuffer(self.binary, kind, width, start + row * step)
                for row in range(accessor["count"])
            ]
        )

    def node(self, index: int, moved: dict) -> np.ndarray:
        node = self.json["nodes"][index] | moved.get(index, {})
        if "matrix" in node:
            own = np.reshape(node["matrix"], (4, 4)).T
        else:
            own = np.eye(4)
            turn = Rotation.from_quat(node.get("rotation", [0, 0, 0, 1])).as_matrix()
            own[:3, :3] = turn * node.get("scale", [1, 1, 1])
            own[:3, 3] = node.get("translation", [0, 0, 0])
        return self.node(self.parents[index], moved) @ own if index in self.parents else own

    def vertices(self, moved: dict) -> np.ndarray:
        """Section 3.7.3.3: the weighted sum of joint transforms times inverse bind matrices."""
        binds = self.numbers(self.skin["inverseBindMatrices"]).reshape(-1, 4, 4).swapaxes(1, 2)
        joints = np.array([self.node(joint, moved) for joint in self.skin["joints"]]) @ binds
        attributes = self.json["meshes"][0]["primitives"][0]["attributes"]
        positions = self.numbers(attributes["POSITION"]).astype(float)
        weights = self.numbers(attributes["WEIGHTS_0"]).astype(float)
        weights /= weights.sum(axis=1, keepdims=True)
        blended = np.einsum("va,vaij->vij", weights, joints[self.numbers(attributes["JOINTS_0"])])
        return np.einsum("vij,vj->vi", blended[:, :3, :3], positions) + blended[:, :3, 3]

    def moved(self, time: float) -> dict:
        """What the first animation makes of the nodes; linear, between keyframes."""
        animation, moved = self.json["animations"][0], {}
        for channel in animation["channels"]:
            sampler = animation["samplers"][channel["sampler"]]
            times = self.numbers(sampler["input"])[:, 0].astype(float)
            values = self.numbers(sampler["output"]).astype(float)
            held = float(np.clip(time, times[0], times[-1]))
            path = channel["target"]["path"]
            if path == "rotation":
                value = Slerp(times, Rotation.from_quat(values))(held).as_quat()
            else:
                value = [np.interp(held, times, column) for column in values.T]
            moved.setdefault(channel["target"]["node"], {})[path] = value
        return moved


def _farthest(points: np.ndarray, others: np.ndarray) -> float:
    """How far a point of one cloud can be from the other cloud."""
    from scipy.spatial import cKDTree

    there, back = cKDTree(others).query(points)[0], cKDTree(points).query(others)[0]
    return float(max(there.max(), back.max()))


@pytest.mark.parametrize(
    "name",
    [
        "webxr_generic_hand_mit/left.glb",
        "webxr_generic_hand_mit/right.glb",
        "cesiumman_ccby/CesiumMan.glb",
    ],
)
def test_foreign_bodies_at_rest_stand_as_their_files_show_them(
    reference_data: Path, name: str
) -> None:
    path = reference_data / name
    mesh = RiggedBody.read(path).mesh
    # Both files show their bodies in the bind pose.
    assert _farthest(mesh.vertices, Plainly(path).vertices({})) < 1e-6
    np.testing.assert_allclose(mesh.weights.sum(axis=1), 1.0, atol=1e-12)
    assert (mesh.parents < np.arange(len(mesh.labels))).all()
    assert (mesh.parents == -1).sum() == 1
    # All edges have a triangle on either side, but those around a wrist.
    ends = np.sort(np.concatenate([mesh.faces[:, [0, 1]], mesh.faces[:, 1:], mesh.faces[:, ::2]]))
    _, counts = np.unique(ends, axis=0, return_counts=True)
    assert (counts == 2).mean() > 0.98


def test_a_foreign_walk_moves_the_vertices_as_the_file_says(reference_data: Path) -> None:
    path = reference_data / "cesiumman_ccby" / "CesiumMan.glb"
    body, plainly = RiggedBody.read(path), Plainly(path)
    (walk,) = body.clips
    assert walk.duration == pytest.approx(2.0)
    for time in (0.0, 0.31, 1.0, 1.777, 5.0):
        moved = body.mesh.posed(walk.at(time))
        assert _farthest(moved, plainly.vertices(plainly.moved(time))) < 1e-6


def test_bones_point_along_themselves_whichever_axes_the_rig_has(reference_data: Path) -> None:
    mesh = RiggedBody.read(reference_data / "cesiumman_ccby" / "CesiumMan.glb").mesh
    for label, child in [("leg_joint_L_2", "leg_joint_L_3"), ("torso_joint_3", None)]:
        bone = mesh.bone(label)
        children = [k for k, parent in enumerate(mesh.parents) if parent == bone]
        assert child is None or children == [mesh.bone(child)]
        way = mesh.rest[children, :3, 3].mean(axis=0) - mesh.rest[bone, :3, 3]
        np.testing.assert_allclose(mesh.rest[bone, :3, 1], way / np.linalg.norm(way), atol=1e-9)
    turns = mesh.rest[:, :3, :3]
    np.testing.assert_allclose(
        turns @ turns.swapaxes(1, 2), np.tile(np.eye(3), (19, 1, 1)), atol=1e-9
    )


def test_a_webxr_hand_gets_its_tree_by_its_names(reference_data: Path) -> None:
    mesh = RiggedBody.read(reference_data / "webxr_generic_hand_mit" / "left.glb").mesh
    assert len(webxr_hand.PARENTS) == 25
    for label, parent in zip(mesh.labels, mesh.parents, strict=True):
        above = webxr_hand.PARENTS[label]
        assert (mesh.labels[parent] if parent >= 0 else None) == above
        if above is not None and "metacarpal" not in label:
            # Neighbours in the tree are neighbours in space: a phalanx is no longer than 6 cm.
            assert np.linalg.norm(mesh.origin(label) - mesh.origin(above)) < 0.065


def _lever(random: np.random.Generator, carriers: int) -> tuple[SkinnedMesh, np.ndarray]:
    """A mesh without sense on a chain of seven bones with a fork, and three poses of it."""
    count, bones = 60, 7
    parents = np.array([-1, 0, 1, 1, 2, 3, 5])
    rest = rigid(Rotation.random(bones, rng=random).as_matrix(), random.normal(size=(bones, 3)))
    weights = random.random((count, carriers))
    mesh = SkinnedMesh(
        vertices=random.normal(size=(count, 3)),
        faces=np.arange(count).reshape(-1, 3),
        labels=tuple(f"bone {bone}" for bone in range(bones)),
        parents=parents,
        rest=rest,
        indices=np.argsort(random.random((count, bones)), axis=1)[:, :carriers],
        weights=weights / weights.sum(axis=1, keepdims=True),
    )
    turns = Rotation.random(3 * bones, rng=random).as_matrix().reshape(3, bones, 3, 3)
    return mesh, rigid(turns, random.normal(size=(3, bones, 3)))


@pytest.mark.parametrize("carriers", [1, 4, 6])
def test_what_is_written_is_read_again(
    tmp_path: Path, random: np.random.Generator, carriers: int
) -> None:
    mesh, poses = _lever(random, carriers)
    turn = Rotation.from_euler("x", 180.0, degrees=True).as_matrix()
    write_gltf(tmp_path / "lever.glb", mesh, poses, 10.0, "lever", turn)
    again = RiggedBody.read(tmp_path / "lever.glb")
    (clip,) = again.clips
    np.testing.assert_allclose(clip.times, [0.0, 0.1, 0.2], atol=1e-7)
    assert sorted(again.mesh.labels) == sorted(mesh.labels)
    for time, pose in zip(clip.times, poses, strict=True):
        np.testing.assert_allclose(
            again.mesh.posed(clip.at(time)), mesh.posed(pose) @ turn.T, atol=1e-5
        )


ARM = {
    "asset": {"version": "2.0"},
    "nodes": [
        {"children": [1, 4], "scale": [0.5, 0.5, 0.5]},
        {"name": "upper", "children": [2], "translation": [0, 0, 1]},
        {
            "name": "between",
            "children": [3],
            "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 2, 0, 0, 1],
        },
        {"name": "lower", "translation": [1, 0, 0]},
        {"mesh": 0, "skin": 0},
    ],
    "skins": [{"joints": [3, 1], "inverseBindMatrices": 0}],
    "meshes": [
        {
            "primitives": [
                {"attributes": {"POSITION": 1, "JOINTS_0": 2, "WEIGHTS_0": 3}},
                {
                    "attributes": {
                        "POSITION": 1,
                        "JOINTS_0": 2,
                        "WEIGHTS_0": 4,
                        "JOINTS_1": 2,
                        "WEIGHTS_1": 5,
                    },
                    "indices": 6,
                },
            ]
        }
    ],
    "animations": [
        {
            "channels": [
                {"sampler": 0, "target": {"node": 3, "path": "rotation"}},
                {"sampler": 1, "target": {"node": 1, "path": "translation"}},
            ],
            "samplers": [
                {"input": 7, "output": 8, "interpolation": "STEP"},
                {"input": 7, "output": 9, "interpolation": "CUBICSPLINE"},
            ],
        }
    ],
}
"""Two joints, the lower one first; primitives with and without indices and a second set."""

HALF = float(np.sqrt(0.5))


def _moved_by(x: float, y: float, z: float) -> list[float]:
    """A matrix by columns; those below say that the joints are at (3, 0, 1) and (0, 0, 1)."""
    return [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1]


ARRAYS = [
    ("MAT4", 5126, [_moved_by(-3, 0, -1), _moved_by(0, 0, -1)]),
    ("VEC3", 5126, [[4, 0, 1], [0, 1, 1], [3, 2, 1]]),
    ("VEC4", 5121, [[0, 0, 0, 0], [1, 0, 0, 0], [0, 1, 0, 0]]),
    ("VEC4", 5121, [[255, 0, 0, 0], [255, 0, 0, 0], [51, 204, 0, 0]]),
    ("VEC4", 5123, [[65535, 0, 0, 0], [65535, 0, 0, 0], [13107, 0, 0, 0]]),
    ("VEC4", 5126, [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0.8, 0, 0]]),
    ("SCALAR", 5125, [[0], [1], [2]]),
    ("SCALAR", 5126, [[0], [1]]),
    ("VEC4", 5126, [[0, 0, 0, 1], [0, 0, HALF, HALF]]),
    ("VEC3", 5126, [[0, 0, 0], [0, 0, 1], [0, 0, 0], [0, 0, 0], [0, 0, 2], [0, 0, 0]]),
]  # fmt: skip


def _write_arm(path: Path, **changes: object) -> Path:
    content = json.loads(json.dumps(ARM | changes))
    binary, views, accessors = b"", [], []
    for index, (kind, component, rows) in enumerate(ARRAYS):
        data = np.array(rows, dtype=KINDS[component]).tobytes()
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data)})
        accessors.append(
            {"bufferView": index, "componentType": component, "count": len(rows), "type": kind}
        )
        if index in (3, 4):
            accessors[-1]["normalized"] = True
        binary += data + bytes(-len(data) % 4)
    uri = "data:application/octet-stream;base64," + base64.b64encode(binary).decode()
    content["buffers"] = [{"byteLength": len(binary), "uri": uri}]
    path.write_text(json.dumps({"bufferViews": views, "accessors": accessors} | content))
    return path


def test_small_integers_scaled_rigs_and_several_sets_are_understood(tmp_path: Path) -> None:
    body = RiggedBody.read(_write_arm(tmp_path / "arm.gltf"))
    mesh, (clip,) = body.mesh, body.clips
    assert mesh.labels == ("upper", "lower")
    # The armature halves all lengths; both primitives hold the same three vertices.
    np.testing.assert_allclose(mesh.vertices, [[2, 0, 0.5], [0, 0.5, 0.5], [1.5, 1, 0.5]])
    np.testing.assert_array_equal(mesh.faces, [[0, 1, 2], [0, 1, 2]])
    np.testing.assert_allclose(mesh.origin("lower"), [1.5, 0, 0.5])
    np.testing.assert_allclose(mesh.rest[0, :3, 1], [1, 0, 0], atol=1e-12)
    pair = mesh.indices[2], mesh.weights[2]
    weights = {int(bone): weight for bone, weight in zip(*pair, strict=True)}
    assert weights == pytest.approx({0: 0.8, 1: 0.2}, abs=1e-5)
    # Before the end the step holds; the spline is halfway between 1 and 2, the tangents being 0.
    np.testing.assert_allclose(clip.at(0.5)[:, 2, 3], [0.75, 0.75])
    np.testing.assert_allclose(clip.at(0.999)[1, :3, :3], mesh.rest[1, :3, :3], atol=1e-12)
    np.testing.assert_allclose(np.linalg.det(clip.at(0.3)[:, :3, :3]), 1.0)
    # At the end the lower joint turns what it carries by a quarter about z.
    np.testing.assert_allclose(mesh.posed(clip.at(1.0))[0], [1.5, 0.5, 1.0], atol=1e-6)


def test_floats_that_are_said_to_be_normalized_are_read_as_they_are(tmp_path: Path) -> None:
    path = _write_arm(tmp_path / "arm.gltf")
    content = json.loads(path.read_text())
    for accessor in content["accessors"]:
        if accessor["componentType"] == 5126:
            accessor["normalized"] = True
    plain = RiggedBody.read(path).mesh
    path.write_text(json.dumps(content))
    np.testing.assert_array_equal(RiggedBody.read(path).mesh.vertices, plain.vertices)


def test_the_tree_of_flat_bones_must_be_named(tmp_path: Path) -> None:
    nodes = [{"children": [1, 3, 4, 2]}, *ARM["nodes"][1:]]
    nodes[1], nodes[2] = {"name": "upper"}, {"name": "between"}
    path = _write_arm(tmp_path / "flat.gltf", nodes=nodes)
    with pytest.raises(DataError, match=r"flat.gltf: 2 bones have no parent \(lower, upper\)"):
        RiggedBody.read(path)
    mesh = RiggedBody.read(path, parents={"lower": "upper", "upper": None}).mesh
    assert mesh.labels == ("upper", "lower")
    for parents, message in [
        ({"lower": "uper", "upper": None}, "no bone 'uper'.*did you mean 'upper'"),
        ({"lower": "upper"}, "the bones upper have no parent"),
        ({"lower": "upper", "upper": "lower"}, "0 bones have no parent"),
    ]:
        with pytest.raises(DataError, match=message):
            RiggedBody.read(path, parents=parents)


def _scaled(scale: list[float]) -> list[dict]:
    return [{"children": [1, 4], "scale": scale}, *ARM["nodes"][1:]]


def _moving(target: dict, sampler: int) -> list[dict]:
    return [ARM["animations"][0] | {"channels": [{"sampler": sampler, "target": target}]}]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"nodes": _scaled([1, 1, 2])}, "scaled unevenly"),
        ({"nodes": _scaled([-1, 1, 1])}, "is mirrored"),
        ({"animations": _moving({"node": 9, "path": "rotation"}, 0)}, "no node 9; the file has 5"),
        ({"animations": _moving({"node": 1, "path": "rotation"}, 5)}, "no sampler 5"),
        ({"animations": _moving({"node": 1, "path": "scale"}, 0)}, "8 numbers; it needs 6"),
        ({"skins": []}, "no skin 0; the file has 0"),
        ({"asset": {"version": "1.0"}}, "not a glTF 2.0 file"),
        ({"extensionsRequired": ["KHR_draco_mesh_compression"]}, "export it without compression"),
        ({"skins": [{"joints": [3, 9], "inverseBindMatrices": 0}]}, "are not all nodes"),
        ({"skins": [{"joints": [3], "inverseBindMatrices": 0}]}, "joint 1; the skin has 1 joints"),
        ({"skins": [{"joints": [3, 2], "inverseBindMatrices": -1}]}, "there is no accessor -1"),
        ({"nodes": [*ARM["nodes"][:4], {"mesh": 0}]}, "no mesh uses one of the 1 skins"),
        ({"buffers": [{"byteLength": 4, "uri": "arm.bin"}]}, "the buffer .arm.bin. is missing"),
        (
            {"meshes": [{"primitives": [{"attributes": {"POSITION": 1}}]}]},
            "lacks POSITION or JOINTS_0",
        ),
        (
            {"meshes": [{"primitives": [ARM["meshes"][0]["primitives"][0] | {"mode": 7}]}]},
            "the mode 7",
        ),
    ],
)  # fmt: skip
def test_what_cannot_be_read_is_refused_with_its_reason(
    tmp_path: Path, changes: dict, message: str
) -> None:
    path = _write_arm(tmp_path / "arm.gltf", **changes)
    if "buffers" in changes:
        path.write_text(json.dumps(json.loads(path.read_text()) | changes))
    with pytest.raises(DataError, match=message) as caught:
        RiggedBody.read(path)
    assert caught.value.place == str(path)


def test_files_that_are_no_gltf_are_refused(tmp_path: Path) -> None:
    with pytest.raises(DataError, match="no such file"):
        RiggedBody.read(tmp_path / "none.glb")
    for name, content in [("a.glb", b"glTF\2\0\0\0"), ("a.gltf", b"{"), ("b.glb", b"other")]:
        (tmp_path / name).write_bytes(content)
        with pytest.raises(DataError, match=r"not a glTF 2\.0 file"):
            RiggedBody.read(tmp_path / name)
