"""glTF files as programs write them: all spellings of one body are the same body."""

import base64
import json
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from places import CASES

from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interchange.gltf.gltf import RiggedBody
from regkit.system.errors import DataError
from regkit.system.notes import RegkitWarning

CASE = CASES / "13-gltf" / "gltfbuffer.gltf"
TYPES = {"<u1": 5121, "<i1": 5120, "<u2": 5123, "<i2": 5122, "<u4": 5125, "<f4": 5126}
SHAPES = {1: "SCALAR", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
Model = dict[str, Any]


@pytest.fixture
def model() -> Model:
    """The rod of the case, on the bones "lower" and "upper"."""
    return json.loads(CASE.read_text())


@pytest.fixture(scope="module")
def rod() -> SkinnedMesh:
    return RiggedBody.read(CASE).mesh


def _data(model: Model) -> bytes:
    return base64.b64decode(model["buffers"][0]["uri"].partition(",")[2])


def _array(model: Model, accessor: int) -> np.ndarray:
    described = model["accessors"][accessor]
    view = model["bufferViews"][described["bufferView"]]
    kind = next(kind for kind, code in TYPES.items() if code == described["componentType"])
    width = next(width for width, name in SHAPES.items() if name == described["type"])
    count = described["count"]
    offset = view.get("byteOffset", 0)
    return np.frombuffer(_data(model), kind, count * width, offset).reshape(count, width)


def _packed(model: Model, values: Any, kind: str, **more: Any) -> int:
    """Appends an array in a buffer of its own, and returns its accessor."""
    rows = np.array(values, dtype=kind)
    uri = "data:application/octet-stream;base64," + base64.b64encode(rows.tobytes()).decode()
    model["buffers"].append({"byteLength": rows.nbytes, "uri": uri})
    view = {"buffer": len(model["buffers"]) - 1, "byteLength": rows.nbytes}
    model["bufferViews"].append(view)
    described = {
        "bufferView": len(model["bufferViews"]) - 1,
        "componentType": TYPES[kind],
        "count": len(rows),
        "type": SHAPES[rows.shape[1]],
    }
    model["accessors"].append(described | more)
    return len(model["accessors"]) - 1


def _primitive(model: Model) -> Model:
    return model["meshes"][0]["primitives"][0]


def _attributes(model: Model) -> Model:
    return _primitive(model)["attributes"]


def _read(folder: Path, model: Model, name: str = "rod.gltf") -> SkinnedMesh:
    path = folder / name
    path.write_text(json.dumps(model))
    return RiggedBody.read(path).mesh


def _check_same(mesh: SkinnedMesh, rod: SkinnedMesh, tolerance: float = 1e-9) -> None:
    assert mesh.labels == rod.labels
    np.testing.assert_allclose(mesh.rest, rod.rest, atol=tolerance)
    np.testing.assert_allclose(_sorted(mesh), _sorted(rod), atol=tolerance)


def _sorted(mesh: SkinnedMesh) -> np.ndarray:
    """The triangles' corners (3 F, 3 + J), with the weights for each bone, in a fixed order."""
    weights = np.zeros((len(mesh.vertices), len(mesh.labels)))
    np.add.at(weights, (np.arange(len(weights))[:, None], mesh.indices), mesh.weights)
    rows = np.concatenate([mesh.vertices, weights], axis=1)[mesh.faces]
    triangles = [min(np.roll(one, k, axis=0).round(4).tolist() for k in range(3)) for one in rows]
    return np.array(sorted(triangles))


def test_the_cases_import(rod: SkinnedMesh) -> None:
    assert rod.labels == ("lower", "upper")
    assert np.ptp(rod.vertices, axis=0) == pytest.approx([0.2, 2.0, 0.4], abs=0.25)
    np.testing.assert_allclose(rod.origin("upper"), [0, 1, 0], atol=1e-6)
    # Both skins have the same joints, and both meshes are the same rod.
    two = RiggedBody.read(CASES / "13-gltf" / "two_skins.gltf").mesh
    assert two.labels == rod.labels
    np.testing.assert_array_equal(two.vertices, rod.vertices)
    assert len(two.faces) == 2 * len(rod.faces)


def _uri(change: Callable[[str], str]) -> Callable[[Model, Path], None]:
    def act(model: Model, _: Path) -> None:
        text = model["buffers"][0]["uri"].partition(",")[2]
        model["buffers"][0]["uri"] = change(text)

    return act


def _external(uri: str, file: str) -> Callable[[Model, Path], None]:
    def act(model: Model, folder: Path) -> None:
        (folder / file).parent.mkdir(exist_ok=True)
        (folder / file).write_bytes(_data(model))
        model["buffers"][0]["uri"] = uri

    return act


@pytest.mark.parametrize(
    "change",
    [
        _uri(lambda text: f"data:application/octet-stream;base64,{text}"),
        _uri(lambda text: f"DATA:;BASE64,{text}"),
        _uri(lambda text: f"data:;charset=utf-8;base64,{text[:40]}\n  {text[40:]}\t"),
        _uri(lambda text: "data:x/y;base64," + text.rstrip("=").replace("+", "-")),
        _uri(lambda text: "data:x/y;base64," + text.replace("=", "%3D").replace("/", "%2F")),
        _external("rod.bin", "rod.bin"),
        _external("a%20rod%C3%A9.bin", "a rodé.bin"),
        _external("a rod.bin", "a rod.bin"),
        _external("100%25.bin", "100%.bin"),
        _external("./bins/../bins/rod.bin", "bins/rod.bin"),
        _external("bins\\rod.bin", "bins/rod.bin"),
    ],
)
def test_buffers_are_found_by_their_uris(
    tmp_path: Path, model: Model, rod: SkinnedMesh, change: Callable[[Model, Path], None]
) -> None:
    change(model, tmp_path)
    _check_same(_read(tmp_path, model), rod)


@pytest.mark.parametrize(
    "uri",
    [
        *("../rod.bin", "%2e%2e/rod.bin", "..\\rod.bin", "a/../../rod.bin", "PATH", "file://PATH"),
        *("link/rod.bin", "link.bin", "http://host/rod.bin", "none.bin", "\0", "", "."),
    ],
)
def test_uris_that_leave_the_folder_are_refused(tmp_path: Path, model: Model, uri: str) -> None:
    outside, folder = tmp_path / "rod.bin", tmp_path / "folder"
    folder.mkdir()
    outside.write_bytes(_data(model))
    (folder / "link").symlink_to(tmp_path)
    (folder / "link.bin").symlink_to(outside)
    model["buffers"][0]["uri"] = uri.replace("PATH", str(outside))
    with pytest.raises(DataError, match="buffer") as caught:
        _read(folder, model)
    assert caught.value.place == str(folder / "rod.gltf")


def _glb(model: Model, chunks: str) -> bytes:
    data = _data(model)
    del model["buffers"][0]["uri"]
    text = json.dumps(model).encode()
    parts = {
        "J": struct.pack("<II", len(text), 0x4E4F534A) + text,
        "B": struct.pack("<II", len(data), 0x004E4942) + data,
        "X": struct.pack("<II", 3, 77) + b"xyz",
    }
    body = b"".join(parts[name] for name in chunks)
    return b"glTF" + struct.pack("<II", 2, 12 + len(body)) + body


@pytest.mark.parametrize("chunks", ["JB", "BJ", "JXB", "XJBX"])
@pytest.mark.parametrize("name", ["rod.glb", "rod.gltf"])
def test_chunks_of_any_order_are_read(
    tmp_path: Path, model: Model, rod: SkinnedMesh, chunks: str, name: str
) -> None:
    (tmp_path / name).write_bytes(_glb(model, chunks))
    _check_same(RiggedBody.read(tmp_path / name).mesh, rod)


def _indexless(model: Model) -> None:
    corners = _array(model, _primitive(model).pop("indices"))[:, 0]
    for name, accessor in list(_attributes(model).items()):
        values = _array(model, accessor)
        kind = values.dtype.str.replace("|", "<")
        _attributes(model)[name] = _packed(model, values[corners], kind)


def _strip(model: Model) -> None:
    corners = _array(model, _primitive(model)["indices"]).reshape(-1, 3)
    # Four triangles without extent lead from each triangle to the next, an even number of steps.
    strip = [corner for a, b, c in corners.tolist() for corner in (a, a, a, b, c, c)]
    _primitive(model).update(mode=5, indices=_packed(model, np.array(strip)[:, None], "<u2"))


def _fans(model: Model) -> None:
    (primitive,) = model["meshes"][0]["primitives"]
    corners = _array(model, primitive["indices"]).reshape(-1, 3, 1)
    model["meshes"][0]["primitives"] = [
        primitive | {"mode": 6, "indices": _packed(model, one, "<u1")} for one in corners
    ]


def _interleaved(model: Model) -> None:
    points, bones, weights = (
        _array(model, _attributes(model)[name]) for name in ("POSITION", "JOINTS_0", "WEIGHTS_0")
    )
    rows = b"".join(
        point.tobytes() + bone.tobytes() + weight.tobytes()
        for point, bone, weight in zip(points, bones, weights, strict=True)
    )
    uri = "data:;base64," + base64.b64encode(rows).decode()
    model["buffers"].append({"byteLength": len(rows), "uri": uri})
    model["bufferViews"].append(
        {"buffer": 1, "byteLength": len(rows), "byteStride": len(rows) // len(points)}
    )
    for name, offset in (("POSITION", 0), ("JOINTS_0", 12), ("WEIGHTS_0", 16)):
        accessor = model["accessors"][_attributes(model)[name]]
        accessor.update(bufferView=len(model["bufferViews"]) - 1, byteOffset=offset)


def _sparse(model: Model) -> None:
    accessor = model["accessors"][_attributes(model)["POSITION"]]
    points = _array(model, _attributes(model)["POSITION"])
    count = len(points)
    places = _packed(model, np.arange(count)[:, None], "<u1")
    values = _packed(model, points, "<f4")
    del accessor["bufferView"]
    accessor["sparse"] = {
        "count": count,
        "indices": {
            "bufferView": model["accessors"][places]["bufferView"],
            "componentType": 5121,
        },
        "values": {"bufferView": model["accessors"][values]["bufferView"]},
    }


def _bytes(kind: str) -> Callable[[Model], None]:
    def act(model: Model) -> None:
        weights = _array(model, _attributes(model)["WEIGHTS_0"])
        top = np.iinfo(kind).max
        own = _packed(model, np.round(weights * top), kind, normalized=True)
        _attributes(model)["WEIGHTS_0"] = own

    return act


def _second_set(model: Model) -> None:
    weights = _array(model, _attributes(model)["WEIGHTS_0"])
    bones = _array(model, _attributes(model)["JOINTS_0"])
    for number, share in enumerate((0.25, 0.75)):
        _attributes(model)[f"WEIGHTS_{number}"] = _packed(model, share * weights, "<f4")
        _attributes(model)[f"JOINTS_{number}"] = _packed(model, bones, "<u1")


def _unused_bones_out_of_range(model: Model) -> None:
    bones = _array(model, _attributes(model)["JOINTS_0"]).copy()
    bones[_array(model, _attributes(model)["WEIGHTS_0"]) == 0.0] = 99
    _attributes(model)["JOINTS_0"] = _packed(model, bones, "<u1")


def _own_skins(model: Model) -> None:
    """A mesh for each bone, with a skin of its own, the second in another space."""
    binds = _array(model, model["skins"][0]["inverseBindMatrices"]).reshape(-1, 4, 4)
    moved = binds.copy()
    moved[:, 3, 0] -= 7.0  # Matrices are stored by columns.
    points = _array(model, _attributes(model)["POSITION"])
    own = json.loads(json.dumps(_primitive(model)))
    own["attributes"]["POSITION"] = _packed(model, points + np.array([7.0, 0.0, 0.0]), "<f4")
    corners = _array(model, _primitive(model)["indices"])
    half = len(corners) // 6 * 3
    own["indices"] = _packed(model, corners[half:], "<u2")
    _primitive(model)["indices"] = _packed(model, corners[:half], "<u2")
    model["meshes"].append({"primitives": [own]})
    matrices = _packed(model, moved.reshape(-1, 16), "<f4")
    model["skins"].append({"joints": model["skins"][0]["joints"], "inverseBindMatrices": matrices})
    model["nodes"].append({"mesh": 1, "skin": 1})


LAYOUTS = (
    *(_indexless, _strip, _fans, _interleaved, _sparse, _bytes("<u1"), _bytes("<u2")),
    *(_second_set, _unused_bones_out_of_range, _own_skins),
)


@pytest.mark.parametrize("change", LAYOUTS)
def test_other_layouts_are_the_same_body(
    tmp_path: Path, model: Model, rod: SkinnedMesh, change: Callable[[Model], None]
) -> None:
    change(model)
    _check_same(_read(tmp_path, model), rod, tolerance=5e-3)


def test_quantized_positions_are_scaled(tmp_path: Path, model: Model, rod: SkinnedMesh) -> None:
    points = _array(model, _attributes(model)["POSITION"])
    rows = np.round(points / 2.5 * 32767)
    own = _packed(model, rows, "<i2", normalized=True)
    _attributes(model)["POSITION"] = own
    model["extensionsRequired"] = ["KHR_mesh_quantization"]
    binds = _array(model, model["skins"][0]["inverseBindMatrices"]).reshape(-1, 4, 4).copy()
    binds[:, :3] *= 2.5
    model["skins"][0]["inverseBindMatrices"] = _packed(model, binds.reshape(-1, 16), "<f4")
    mesh = _read(tmp_path, model)
    np.testing.assert_allclose(_sorted(mesh), _sorted(rod), atol=2e-3)


def _extra(**fields: Any) -> Callable[[Model], None]:
    def act(model: Model) -> None:
        for key, value in fields.items():
            model[key] = model.get(key, []) + value

    return act


def _morphing(model: Model) -> None:
    _primitive(model)["targets"] = [{"POSITION": _attributes(model)["POSITION"]}]


def _with_lines(model: Model) -> None:
    model["meshes"][0]["primitives"].append(_primitive(model) | {"mode": 1})


def _doubled_weights(model: Model) -> None:
    weights = _array(model, _attributes(model)["WEIGHTS_0"])
    _attributes(model)["WEIGHTS_0"] = _packed(model, 2.0 * weights, "<f4")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (_extra(skins=[{"joints": [0]}, {"joints": [99]}]), "left out: 2"),
        (_morphing, "morph targets"),
        (_with_lines, "points or lines"),
        (_doubled_weights, "do not sum to 1"),
    ],
)
def test_what_is_left_out_is_told(
    tmp_path: Path, model: Model, rod: SkinnedMesh, change: Callable[[Model], None], words: str
) -> None:
    change(model)
    with pytest.warns(RegkitWarning, match=words):
        _check_same(_read(tmp_path, model), rod)


def _attribute(name: str, row: int, value: float, kind: str) -> Callable[[Model], None]:
    def act(model: Model) -> None:
        values = _array(model, _attributes(model)[name]).astype(kind)
        values[row, 0] = value
        _attributes(model)[name] = _packed(model, values, kind)

    return act


def _node(index: int, **fields: Any) -> Callable[[Model], None]:
    return lambda model: model["nodes"][index].update(fields)


def _accessor(index: int, **fields: Any) -> Callable[[Model], None]:
    return lambda model: model["accessors"][index].update(fields)


def _whole(**fields: Any) -> Callable[[Model], None]:
    return lambda model: model.update(fields)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (_attribute("JOINTS_0", 3, -1, "<i1"), "no index"),
        (_attribute("JOINTS_0", 3, np.nan, "<f4"), "no index"),
        (_attribute("JOINTS_0", 3, 2, "<u2"), "follows joint 2; the skin has 2"),
        (_attribute("WEIGHTS_0", 3, -0.5, "<f4"), "vertex 3"),
        (_attribute("WEIGHTS_0", 3, np.nan, "<f4"), "NaN"),
        (_attribute("POSITION", 3, np.inf, "<f4"), "infinite"),
        (lambda model: _primitive(model).update(indices=_packed(model, [[0], [1], [99]], "<u1")),
         "vertex 99; the mesh has 20"),
        (lambda model: _primitive(model).update(indices=_packed(model, [[0], [1], [-1]], "<i2")),
         "no index"),
        (lambda model: _primitive(model).update(indices=_packed(model, [[0], [1]], "<u2")),
         "multiple of 3"),
        (lambda model: _primitive(model).update(mode=0), "triangles"),
        (_node(2, children=[0]), "cycle"),
        (_node(1, children=[1]), "child 1"),
        (_node(1, children=["x"]), "x"),
        (_node(2, translation=[0, np.nan, 0]), "not finite"),
        (_node(2, rotation=[0, 0, 0, 0]), "rotation of zero"),
        (_node(2, scale=[1, 1]), "wrong size"),
        (_node(0, scale=[1, 2, 1]), "unevenly"),
        (_node(0, scale=[-1, 1, 1]), "mirrored"),
        (_node(3, skin=7), "no skin 7"),
        (_node(3, mesh=-1), "no mesh -1"),
        (_accessor(0, count=10**18), "accessor 0"),
        (_accessor(0, bufferView=-1), "bufferView -1"),
        (_accessor(0, bufferView=None), "POSITION|triangles|joints|height|accessor|nothing"),
        (_accessor(0, componentType=7), "accessor 0"),
        (_accessor(0, byteOffset=-4), "accessor 0"),
        (_accessor(2, count=1), "1 matrices"),
        (_accessor(2, type="VEC4", count=8), "of 4"),
        (_whole(asset={"version": "1.0"}), "1.0; export"),
        (_whole(asset=7), "no version"),
        (_whole(nodes=5), "glTF"),
        (_whole(nodes=[]), "no nodes"),
        (_whole(extensionsRequired=["EXT_meshopt_compression"]), "without compression"),
    ],
)  # fmt: skip
@pytest.mark.filterwarnings("ignore:.*points or lines:regkit.system.notes.RegkitWarning")
def test_what_is_wrong_is_refused_with_its_reason(
    tmp_path: Path, model: Model, change: Callable[[Model], None], words: str
) -> None:
    change(model)
    if "POSITION|" in words:
        model["extensionsUsed"] = ["KHR_draco_mesh_compression"]
        words = "without compression"
    with pytest.raises(DataError, match=words) as caught:
        _read(tmp_path, model)
    assert caught.value.place == str(tmp_path / "rod.gltf")


def test_skins_in_different_poses_are_refused(tmp_path: Path, model: Model) -> None:
    _own_skins(model)
    binds = _array(model, model["skins"][0]["inverseBindMatrices"]).reshape(-1, 4, 4).copy()
    binds[1, 3, 1] -= 0.5
    matrices = _packed(model, binds.reshape(-1, 16), "<f4")
    model["skins"][1]["inverseBindMatrices"] = matrices
    with pytest.raises(DataError, match="where another skin has it"):
        _read(tmp_path, model)


@pytest.mark.parametrize(
    "content",
    [
        b"glTF",
        b"glTF" + struct.pack("<II", 1, 12),
        b"glTF" + struct.pack("<IIII", 2, 999, 900, 0x4E4F534A) + b"{}",
        b"glTF" + struct.pack("<II", 2, 12),
        b"glTF" + struct.pack("<IIII", 2, 21, 1, 0x4E4F534A) + b"\xff",
        b"[" * 100_000,
        b'{"asset": {"version": "2.0"}, "nodes": ' + b"[" * 5000 + b"]" * 5000 + b"}",
        b"\0" * 40,
        b"",
    ],
)
@pytest.mark.filterwarnings("ignore:.*announces:regkit.system.notes.RegkitWarning")
def test_damaged_containers_are_refused(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "rod.glb").write_bytes(content)
    with pytest.raises(DataError, match=r"glTF 2\.0") as caught:
        RiggedBody.read(tmp_path / "rod.glb")
    assert caught.value.place == str(tmp_path / "rod.glb")
