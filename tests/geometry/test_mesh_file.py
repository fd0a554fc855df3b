"""Mesh files: whatever is in them, what is read is a mesh, or the array is named."""

import io
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from places import CASES

from regkit.geometry.skinned_mesh import KEYS, SkinnedMesh
from regkit.system.errors import DataError
from regkit.system.notes import RegkitWarning

Arrays = dict[str, Any]


@pytest.fixture
def arrays() -> Arrays:
    """A tetrahedron on two bones."""
    rest = np.tile(np.eye(4), (2, 1, 1))
    rest[1, 1, 3] = 0.5
    return {
        "rest_vertices": np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=np.float32),
        "faces": np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], dtype=np.uint16),
        "labels": np.array(["lower", "upper"]),
        "parents": np.array([-1, 0], dtype=np.int16),
        "rest_bone_poses": rest,
        "skin_indices": np.array([[0, 1]] * 4, dtype=np.uint8),
        "skin_weights": np.array([[0.25, 0.75]] * 4, dtype=np.float32),
    }


def _write(folder: Path, arrays: Arrays) -> Path:
    np.savez(folder / "mesh.npz", **arrays)
    return folder / "mesh.npz"


def _with(values: Any, at: Any, value: Any) -> Any:
    changed = np.array(values, dtype=np.float64)
    changed[at] = value
    return changed


def test_a_mesh_file_is_read(tmp_path: Path, arrays: Arrays) -> None:
    mesh = SkinnedMesh.read(_write(tmp_path, arrays))
    np.testing.assert_array_equal(mesh.vertices, arrays["rest_vertices"])
    np.testing.assert_array_equal(mesh.faces, arrays["faces"])
    assert mesh.labels == ("lower", "upper")


def test_bones_without_weight_are_padding(tmp_path: Path, arrays: Arrays) -> None:
    arrays["skin_weights"][:] = [1.0, 0.0]
    arrays["skin_indices"][:, 1] = 255
    assert (SkinnedMesh.read(_write(tmp_path, arrays)).indices == 0).all()


def test_weights_are_divided_by_their_sums(tmp_path: Path, arrays: Arrays) -> None:
    arrays["skin_weights"] = 4.0 * arrays["skin_weights"]
    with pytest.warns(RegkitWarning, match="4 vertices do not sum to 1"):
        mesh = SkinnedMesh.read(_write(tmp_path, arrays))
    np.testing.assert_allclose(mesh.weights, [[0.25, 0.75]] * 4)


@pytest.mark.parametrize(
    ("key", "change", "words"),
    [
        ("rest_vertices", lambda one: _with(one, (2, 1), np.nan), "NaN or infinite.*row 2"),
        ("rest_vertices", lambda one: one[:, :2], "shape"),
        ("rest_vertices", lambda one: one.astype(str), "type"),
        ("faces", lambda one: _with(one, (1, 0), -1), r"\[-1.* row 1.*0 to 3"),
        ("faces", lambda one: _with(one, (3, 2), 4), "row 3"),
        ("faces", lambda one: _with(one, (0, 0), 0.5), "row 0"),
        ("labels", lambda _: np.array(["a", "a"]), "unique"),
        ("labels", lambda _: np.array(["a"]), "1 names"),
        ("parents", lambda _: np.array([-1, 1]), "1 for bone 1"),
        ("parents", lambda _: np.array([-1, -1]), "-1 for bone 1"),
        ("parents", lambda _: np.array([0, 0]), "0 for bone 0"),
        ("rest_bone_poses", lambda one: 1000.0 * one, "bone 0 is no rigid"),
        ("rest_bone_poses", lambda one: _with(one, (1, 0, 0), -1.0), "bone 1 is no rigid"),
        ("rest_bone_poses", lambda one: one[:1], "shape"),
        ("skin_indices", lambda one: _with(one, (2, 0), 2), "row 2"),
        ("skin_indices", lambda one: _with(one, (2, 0), -1), "row 2"),
        ("skin_indices", lambda one: one[:3], "row for each"),
        ("skin_weights", lambda one: _with(one, (1, 0), np.nan), "NaN"),
        ("skin_weights", lambda one: _with(one, (1, 0), -0.5), "negative"),
        ("skin_weights", lambda one: _with(one, 1, 0.0), "each vertex needs one"),
        ("faces", lambda _: np.array([[object()] * 3]), "pickle|object"),
    ],
)  # fmt: skip
def test_a_wrong_array_is_named(
    tmp_path: Path, arrays: Arrays, key: str, change: Any, words: str
) -> None:
    arrays[key] = change(arrays[key])
    path = _write(tmp_path, arrays)
    with pytest.raises(DataError, match=words) as caught:
        SkinnedMesh.read(path)
    assert caught.value.place == str(path)
    assert key in caught.value.message or "object" in words or key == "skin_indices"


@pytest.mark.parametrize("key", KEYS)
def test_a_missing_array_is_named(tmp_path: Path, arrays: Arrays, key: str) -> None:
    del arrays[key]
    with pytest.raises(DataError, match=f"no array '{key}'"):
        SkinnedMesh.read(_write(tmp_path, arrays))


def test_a_header_that_asks_for_terabytes_takes_no_memory(tmp_path: Path, arrays: Arrays) -> None:
    path = _write(tmp_path, arrays)
    stream = io.BytesIO()
    header = {"descr": "<f4", "fortran_order": False, "shape": (10**13, 3)}
    np.lib.format.write_array_header_1_0(stream, header)
    with zipfile.ZipFile(path) as archive:
        held = {name: archive.read(name) for name in archive.namelist()}
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in (held | {"rest_vertices.npy": stream.getvalue()}).items():
            archive.writestr(name, content)
    with pytest.raises(DataError, match="'rest_vertices' of shape"):
        SkinnedMesh.read(path)


@pytest.mark.parametrize("content", [b"", b"PK\3\4 no archive", b"\x93NUMPY\1\0v\0{}", bytes(99)])
def test_a_file_that_is_no_archive_is_refused(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "mesh.npz"
    path.write_bytes(content)
    with pytest.raises(DataError, match="not a skinned mesh"):
        SkinnedMesh.read(path)


def test_the_case_of_weights_is_refused() -> None:
    with pytest.raises(DataError, match="skin_weights has NaN"):
        SkinnedMesh.read(CASES / "21-meshes" / "nan_weights.npz")


@pytest.mark.parametrize(
    ("key", "damage"),
    [
        ("labels", lambda labels: np.arange(len(labels))),
        ("labels", lambda labels: np.array(["lower", "up\x1bper"])),
        ("labels", lambda labels: np.array([f"bone {n}" for n in range(100_000)])),
        ("labels", lambda labels: np.array(["lower"] * 100_000)),
        ("rest_vertices", lambda vertices: 1e20 * vertices),
        ("parents", lambda parents: parents[:, None]),
    ],
)
def test_names_and_lengths_that_no_skin_has_are_refused(
    tmp_path: Path, arrays: Arrays, key: str, damage: Any
) -> None:
    arrays[key] = damage(arrays[key])
    with pytest.raises(DataError, match=key):
        SkinnedMesh.read(_write(tmp_path, arrays))
