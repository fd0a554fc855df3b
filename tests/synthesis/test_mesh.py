"""A skinned mesh deforms as its makers say, and its joints stay together."""

from __future__ import annotations

import numpy as np
import pytest
from places import REFERENCE

from regkit.geometry.rotation import vector_to_matrix
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.errors import DataError
from regkit_synthesis.assets import (
    ASSETS,
    average_hand,
    average_human,
    slim_hand,
    small_human,
)
from regkit_synthesis.bodies.bodies import human_landmarks
from regkit_synthesis.bodies.landmarks import hand_landmarks, placed

SHARED = REFERENCE / "anny_cc0"
NAMES = {"body": "anny_body_cmu_rig", "hand_right": "anny_hand_R"}


@pytest.fixture(scope="module", params=list(NAMES))
def name(request):
    return request.param


@pytest.fixture(scope="module")
def mesh(name):
    return SkinnedMesh.read(ASSETS / "anny" / f"{name}.npz")


def _random_turns(mesh, seed=0):
    angles = np.random.default_rng(seed).normal(scale=0.5, size=(len(mesh.labels), 3))
    return vector_to_matrix(angles)


@pytest.mark.parametrize("source", ["anny_body", "anny_body_cmu_rig", "anny_hand_R"])
def test_posed_reproduces_the_vertices_of_anny(source):
    path = SHARED / f"{source}.npz"
    if not path.is_file():
        pytest.skip(f"{path} is absent: anny's posed vertices do not ship with regkit")
    data = np.load(path)
    for shape, bone_poses, expected in zip(
        data["posed_shape_id"], data["posed_bone_poses"], data["posed_vertices"], strict=True
    ):
        mesh = SkinnedMesh(
            data["rest_vertices"][shape].astype(float),
            data["faces"].astype(np.intp),
            tuple(data["labels"]),
            data["parents"].astype(np.intp),
            data["rest_bone_poses"][shape].astype(float),
            data["skin_i"].astype(np.intp),
            data["skin_w"].astype(float),
        )
        assert np.abs(mesh.posed(bone_poses) - expected).max() < 1e-5


def test_shipped_mesh_reproduces_the_vertices_of_anny(name, mesh):
    path = SHARED / f"{NAMES[name]}.npz"
    if not path.is_file():
        pytest.skip(f"{path} is absent: anny's posed vertices do not ship with regkit")
    data = np.load(path)
    for index in np.flatnonzero(data["posed_shape_id"] == 0):
        vertices = mesh.posed(data["posed_bone_poses"][index])
        assert np.abs(vertices - data["posed_vertices"][index]).max() < 1e-5


@pytest.mark.parametrize(
    ("make", "source"), [(small_human, "anny_body_cmu_rig"), (slim_hand, "anny_hand_R")]
)
def test_other_shape_reproduces_the_vertices_of_anny(make, source):
    path = SHARED / f"{source}.npz"
    if not path.is_file():
        pytest.skip(f"{path} is absent: anny's posed vertices do not ship with regkit")
    data, mesh = np.load(path), make()
    for index in np.flatnonzero(data["posed_shape_id"] == 1):
        vertices = mesh.posed(data["posed_bone_poses"][index])
        assert np.abs(vertices - data["posed_vertices"][index]).max() < 1e-5


def test_other_shapes_have_other_bones_of_the_same_tree():
    for one, other in ((average_human(), small_human()), (average_hand(), slim_hand())):
        assert one.labels == other.labels
        assert np.array_equal(one.faces, other.faces)
        assert np.abs(one.vertices - other.vertices).max() > 0.01
        assert np.allclose(other.posed(other.rest), other.vertices, atol=1e-7)
    height = np.ptp(average_human().vertices[:, 2]) - np.ptp(small_human().vertices[:, 2])
    assert height == pytest.approx(0.144, abs=0.001)


def test_reshaped_refuses_the_shape_of_another_mesh():
    with pytest.raises(DataError, match=r"for this mesh it must be \(13718, 3\)"):
        average_human().reshaped(ASSETS / "anny" / "hand_right_slim.npz")


def test_posed_at_rest_is_the_rest_mesh(mesh):
    assert np.allclose(mesh.posed(mesh.rest), mesh.vertices, atol=1e-7)


def test_posed_moves_with_a_rigid_motion(mesh):
    motion = np.eye(4)
    motion[:3, :3] = vector_to_matrix(np.array([0.3, -0.8, 0.5]))
    motion[:3, 3] = [1.0, 2.0, 3.0]
    expected = mesh.posed(mesh.rest) @ motion[:3, :3].T + motion[:3, 3]
    assert np.allclose(mesh.posed(motion @ mesh.rest), expected, atol=1e-12)


def test_turned_by_nothing_is_the_rest_pose(mesh):
    still = np.tile(np.eye(3), (len(mesh.labels), 1, 1))
    assert np.allclose(mesh.rotated(still, mesh.rest[0, :3, 3]), mesh.rest, atol=1e-12)


def test_turned_keeps_the_bone_lengths(mesh):
    poses = mesh.rotated(_random_turns(mesh), np.array([0.1, 0.2, 0.3]))
    bones = np.arange(1, len(mesh.labels))
    before = mesh.rest[bones, :3, 3] - mesh.rest[mesh.parents[bones], :3, 3]
    after = poses[bones, :3, 3] - poses[mesh.parents[bones], :3, 3]
    assert np.allclose(np.linalg.norm(after, axis=1), np.linalg.norm(before, axis=1), atol=1e-12)


def test_landmarks_at_rest_lie_where_they_are_said_to(mesh, name):
    landmarks = human_landmarks(mesh) if name == "body" else hand_landmarks(mesh)
    positions = placed(landmarks, mesh, mesh.rest)
    assert len(landmarks) == {"body": 20, "hand_right": 21}[name]
    assert np.allclose(positions, [mark.position for mark in landmarks.values()], atol=1e-12)


def test_landmarks_follow_their_bones(mesh, name):
    landmarks = human_landmarks(mesh) if name == "body" else hand_landmarks(mesh)
    poses = mesh.rotated(_random_turns(mesh), np.zeros(3))
    joint, bone = {"body": ("left_knee", "LeftLeg"), "hand_right": ("index_pip", "finger2-2.R")}[
        name
    ]
    position = placed(landmarks, mesh, poses)[list(landmarks).index(joint)]
    assert np.allclose(position, poses[mesh.bone(bone), :3, 3], atol=1e-6)


def test_landmarks_of_the_person_s_left_are_at_its_left():
    landmarks = human_landmarks(SkinnedMesh.read(ASSETS / "anny" / "body.npz"))
    for joint, landmark in landmarks.items():
        side = {"left": 1.0, "right": -1.0}.get(joint.split("_")[0], 0.0)
        assert np.sign(np.round(landmark.position[0], 2)) == side


def test_fingertip_lies_beyond_the_last_joint():
    mesh = SkinnedMesh.read(ASSETS / "anny" / "hand_right.npz")
    landmarks = hand_landmarks(mesh)
    for finger in ("thumb_ip", "index_dip", "middle_dip", "ring_dip", "little_dip"):
        joint, tip = landmarks[finger], landmarks[finger.split("_")[0] + "_tip"]
        length = np.linalg.norm(tip.position - joint.position)
        along = (tip.position - joint.position) @ mesh.rest[joint.bone, :3, 1]
        assert 0.015 < along <= length < 0.04


def test_read_names_a_missing_file(tmp_path):
    with pytest.raises(DataError, match=r"nothing\.npz: there is no such file"):
        SkinnedMesh.read(tmp_path / "nothing.npz")


def test_read_names_a_missing_array(tmp_path):
    np.savez(tmp_path / "half.npz", rest_vertices=np.zeros((1, 3)))
    with pytest.raises(DataError, match="faces"):
        SkinnedMesh.read(tmp_path / "half.npz")


def test_read_refuses_what_is_no_npz_file(tmp_path):
    path = tmp_path / "text.npz"
    path.write_text("not a mesh")
    with pytest.raises(DataError, match=r"not a skinned mesh"):
        SkinnedMesh.read(path)


def test_unknown_bone_is_answered_with_the_known_ones(mesh):
    with pytest.raises(DataError, match="no bone 'Tail'; it has"):
        mesh.bone("Tail")
