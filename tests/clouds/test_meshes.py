"""Meshes: polygons, indices, counts, and what a damaged file says."""

import base64
import json
from pathlib import Path

import numpy as np
import pytest

from regkit.clouds import read_cloud
from regkit.clouds.formats.polygons import Polygons
from regkit.system.errors import DataError
from regkit.system.notes import RegkitWarning

CASES = Path(__file__).parents[1] / "cases"
SQUARE = [[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]]
V = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\n"
OFF = "0 0 0\n2 0 0\n2 1 0\n0 1 0\n4 0 1 2 3\n"
PLY = (
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
    "property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n2 0 0\n2 1 0\n0 1 0\n"
)
SOLID = (
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 2 1 0\nendloop\n"
    "endfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 1 0\nvertex 0 1 0\n"
    "endloop\nendfacet\nendsolid a\n"
)


def binary_ply(order, lengths="uchar", corners="int", *, faces=((0, 1, 2), (0, 2, 3)), extra=b""):
    kinds = {"uchar": "u1", "int": "i4", "ushort": "u2", "uint": "u4"}
    sign = "<" if order == "little" else ">"
    header = (
        f"ply\nformat binary_{order}_endian 1.0\ncomment made up\nelement vertex 4\n"
        "property uchar red\nproperty float z\nproperty double x\nproperty short y\n"
        f"element face {len(faces)}\nproperty list {lengths} {corners} vertex_index\n"
        "property uchar flag\nend_header\n"
    )
    dtype = [("r", "u1"), ("z", sign + "f4"), ("x", sign + "f8"), ("y", sign + "i2")]
    rows = np.zeros(4, dtype)
    rows["x"], rows["y"], rows["z"] = np.array(SQUARE).T
    body = b"".join(
        np.array([len(face)], sign + kinds[lengths]).tobytes()
        + np.array(face, sign + kinds[corners]).tobytes()
        + b"\1"
        for face in faces
    )
    return header.encode() + rows.tobytes() + body + extra


def stl(count=2, held=2):
    triangle = np.zeros(1, [("n", "<f4", 3), ("c", "<f4", (3, 3)), ("a", "<u2")])
    parts = []
    for corners in ([0, 1, 2], [0, 2, 3])[:held]:
        triangle["c"] = np.array(SQUARE, float)[corners]
        parts.append(triangle.tobytes())
    return b"solid but binary".ljust(80) + count.to_bytes(4, "little") + b"".join(parts)


def gltf(**changes):
    """Returns a glTF file of the square; changes replace entries by their path."""
    data = np.array(SQUARE, "<f4").tobytes() + np.array([0, 1, 2, 0, 2, 3], "<u2").tobytes()
    content = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"children": [1], "scale": [0.5, 0.5, 0.5]}, {"mesh": 0, "scale": [2, 2, 2]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12},
        ],
        "buffers": [{"byteLength": 60, "uri": "data:application/gltf-buffer;base64,"
                     + base64.b64encode(data).decode()}],
    }  # fmt: skip
    for path, value in changes.items():
        *parents, last = path.split("__")
        entry = content
        for key in parents:
            entry = entry[int(key) if key.isdecimal() else key]
        entry[int(last) if last.isdecimal() else last] = value
    return json.dumps(content)


def quantized_gltf():
    """Returns the square with integers for coordinates, after the floating-point ones."""
    corners = np.array(SQUARE, "<i2").tobytes()
    uri = "data:;base64," + base64.b64encode(corners).decode()
    content = json.loads(gltf(accessors__0__componentType=5122, accessors__0__bufferView=2))
    content["buffers"].append({"byteLength": len(corners), "uri": uri})
    content["bufferViews"].append({"buffer": 1, "byteLength": len(corners)})
    content["extensionsRequired"] = ["KHR_mesh_quantization"]
    return json.dumps(content)


@pytest.fixture
def read(tmp_path):
    def reader(name, content):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return read_cloud(path)

    return reader


@pytest.mark.parametrize("name", ["plain_quad.obj", "mixed_plain.obj", "quads.off"])
def test_polygons_of_another_program_are_its_whole_surface(name):
    points = read_cloud(CASES / "08-obj-quads" / name)
    np.testing.assert_allclose(points.min(axis=0), 0.0, atol=1e-3)
    np.testing.assert_allclose(points.max(axis=0), [1.0, 0.9, 0.7], atol=1e-3)
    np.testing.assert_allclose(
        np.sort(points, axis=0).mean(axis=0),
        np.sort(read_cloud(CASES / "08-obj-quads/quads.off"), axis=0).mean(axis=0),
        atol=0.01,
    )


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.obj", V + "f 1 2 3 4\n"),
        ("a.obj", V + "f -4 -3 -2 -1\n"),
        ("a.obj", "f 1//1 2//1 3//1\nf 1/1/1 3/3 4\n" + V),
        ("a.obj", V.replace("\n", " 1.0\n") + "o a\ng b\ns off\nusemtl c\nf 1 2 3 4 # square\n"),
        ("a.obj", V.replace("\n", " 0.1 0.2 0.3\n") + "f 1 2 \\\n3 4\nvn 0 0 1\nvt 0 0\n"),
        ("a.off", "OFF\n4 1 0\n" + OFF),
        ("a.off", "# made up\nOFF 4 1 0 # counts\n" + OFF),
        ("a.off", "OFF4 1\n" + OFF),
        ("a.off", "COFF\n4 1 4\n" + OFF.replace("0\n", "0 9 9 9 9\n")),
        ("a.off", "OFF\n4 2 0\n" + OFF.replace("4 0 1 2 3", "3 0 1 2 255 0 0\n3 0 2 3")),
        ("a.ply", PLY.format(1) + "4 0 1 2 3\n"),
        ("a.ply", PLY.format(2) + "3 0 1 2\n3 0 2 3\n"),
        ("a.ply", (PLY.format(1) + "4 0 1 2 3\n").replace("\n", "\r\n")),
        ("a.ply", binary_ply("little")),
        ("a.ply", binary_ply("big", "ushort", "uint")),
        ("a.ply", binary_ply("big", "int", "uchar", faces=[(0, 1, 2, 3)])),
        ("a.stl", SOLID),
        ("a.stl", SOLID.upper()),
        ("a.stl", stl()),
        ("a.gltf", gltf()),
        ("a.gltf", quantized_gltf()),
        ("a.gltf", gltf(meshes__0__primitives__0={"attributes": {"POSITION": 0}, "mode": 6})),
        ("a.gltf", gltf(meshes__0__primitives__0={"attributes": {"POSITION": 0}, "mode": 5})),
    ],
)  # fmt: skip
def test_square_is_covered_evenly_in_every_format(read, name, content):
    points = read(name, content)
    assert points.shape == (20_000, 3)
    if '"mode": 5' not in str(content):
        np.testing.assert_allclose(points.mean(axis=0), [1.0, 0.5, 0.0], atol=0.02)
    np.testing.assert_allclose(points.max(axis=0), [2.0, 1.0, 0.0], atol=0.05)


@pytest.mark.parametrize(
    ("name", "content", "told"),
    [
        ("a.off", "OFF\n4 2 0\n" + OFF.replace("4 0 1 2 3", "4 0 1 2 3\n2 0 1"), "1 faces"),
        ("a.ply", binary_ply("little", faces=[(0, 1, 2), (0, 1), (0, 2, 3)]), "1 faces"),
        ("a.obj", V + "v 9 9 9\nf 1 2 3 4\n", "1 of 5 vertices"),
        ("a.obj", V + "f 1 2 3 4\nsurf 0 1 0 1 1\n", "curved"),
    ],
)
def test_what_is_passed_over_is_told(read, name, content, told):
    with pytest.warns(RegkitWarning, match=told):
        points = read(name, content)
    np.testing.assert_allclose(points.max(axis=0), [2.0, 1.0, 0.0], atol=0.05)


@pytest.mark.parametrize("name", ["c.off", "few.off", "idx.off", "short.off", "idx.ply", "neg.ply"])
def test_damaged_mesh_is_refused_with_its_place(name):
    with pytest.raises(DataError, match=name.replace(".", r"\.")):
        read_cloud(CASES / "21-meshes" / name)


@pytest.mark.parametrize(
    ("name", "content", "word"),
    [
        ("a.obj", V + "f 1 2 5\n", "obj:5"),
        ("a.obj", V + "f 1 2 -5\n", "obj:5"),
        ("a.obj", V + "f 0 1 2\n", "obj:5"),
        ("a.obj", V + "f 1 2 x\n", "obj:5"),
        ("a.obj", "v 0,5 0,5 0,5\n", "obj:1"),
        ("a.obj", "v 1 2\n", "obj:1"),
        ("a.obj", V + "v nan 0 0\nf 1 2 5\n", "NaN"),
        ("a.obj", V + "f 1 1 1\n", "no area"),
        ("a.obj", "", "no points"),
        ("a.off", "OFF\n4 1 0\n" + OFF[:-10], "announces"),
        ("a.off", "OFF\n4 1 0\n" + OFF.replace("2 1 0", "2 1"), "off:5"),
        ("a.off", "OFF\n4 1 0\n" + OFF.replace("4 0 1", "5 0 1"), "off:7"),
        ("a.off", "OFF\n4 1 0\n" + OFF.replace("2 3\n", "2 -1\n"), "off:7"),
        ("a.off", "OFF\n99999999999 1 0\n" + OFF, "off:2"),
        ("a.off", "OFF BINARY\n", "off:1"),
        ("a.off", "4OFF\n4 1 0\n" + OFF, "4OFF"),
        ("a.off", "OFF\n", "missing"),
        ("a.ply", PLY.format(1), "holds 0"),
        ("a.ply", PLY.format(1) + "4 0 1 2 3\n4 0 1 2 3\n", "1 lines more"),
        ("a.ply", PLY.format(1) + "4 0 1 2\n", "ply:14"),
        ("a.ply", PLY.format(1) + "3 0 1 2.5\n", "ply:14"),
        ("a.ply", PLY.format(1) + "3 0 1 4\n", "vertex 4"),
        ("a.ply", PLY.format(10**12) + "3 0 1 2\n", "announces"),
        ("a.ply", PLY.format(1).replace("double x", "double a") + "3 0 1 2\n", "x, y and z"),
        ("a.ply", PLY.format(1).replace("double x", "quad x"), "ply:4"),
        ("a.ply", PLY.format(1).replace("list uchar", "list float"), "ply:8"),
        ("a.ply", binary_ply("little")[:-1], "holds"),
        ("a.ply", binary_ply("little", extra=b"more"), "4 bytes more"),
        ("a.ply", binary_ply("little", faces=[(0, 1, -1)]), "vertex -1"),
        ("a.ply", binary_ply("little", "int", faces=[()]).replace(b"\0\0\0\0\1", b"\xff" * 5), ""),
        ("a.stl", stl(3), "announces 3"),
        ("a.stl", stl(2, 1), ""),
        ("a.stl", SOLID[:-40], "stl:"),
        ("a.stl", SOLID.replace("vertex 2 1 0\nendl", "endl"), "stl:6"),
        ("a.stl", SOLID.replace("2 1 0", "2 1"), "stl:6"),
        ("a.gltf", gltf(accessors__1__count=10**12), "gltf"),
        ("a.gltf", gltf(accessors__1__count=-1), "invalid size"),
        ("a.gltf", gltf(accessors__0__count=3), "vertex 3"),
        ("a.gltf", gltf(bufferViews__0__byteLength=10**9, accessors__0__count=99), "gltf"),
        ("a.gltf", gltf(nodes__1__children=[0]), "several parents"),
        ("a.gltf", gltf(scenes__0__nodes=[7]), "node 7"),
        ("a.gltf", gltf(buffers__0__uri="../../etc/passwd"), "outside"),
        ("a.gltf", gltf(buffers__0__uri="no.bin"), "no.bin"),
        ("a.gltf", gltf(accessors__0__sparse={}), "accessor 0"),
        ("a.gltf", gltf(asset__version="1.0"), "2.0"),
        ("a.gltf", gltf(extensionsRequired=["KHR_draco_mesh_compression"]), "draco"),
        ("a.gltf", "[" * 5000, "gltf"),
        ("a.glb", b"glTF\2\0\0\0" + (99).to_bytes(4, "little"), "99"),
    ],
)
@pytest.mark.filterwarnings("ignore::regkit.system.notes.RegkitWarning")
def test_mesh_that_is_not_what_it_announces_is_refused(read, name, content, word):
    with pytest.raises(DataError) as caught:
        read(name, content)
    assert word in str(caught.value)


def test_triangles_of_a_polygon_cover_it_once(random):
    """A star with dents: fans would cover what lies outside."""
    angles = np.linspace(0.0, 2.0 * np.pi, 14, endpoint=False)
    radii = np.where(np.arange(14) % 2, 0.3, 1.0)
    flat = np.column_stack([radii * np.cos(angles), radii * np.sin(angles), np.zeros(14)])
    frame = np.linalg.qr(random.normal(size=(3, 3)))[0]
    for order in (np.arange(14), np.arange(14)[::-1], np.roll(np.arange(14), 1)):
        corners = flat @ frame.T
        triangles = Polygons.of("a", [order.tolist()]).triangles(corners)
        sides = corners[triangles[:, 1:]] - corners[triangles[:, :1]]
        areas = 0.5 * np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
        assert len(triangles) == 12
        x, y, _ = flat.T
        outline = 0.5 * abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
        assert areas.sum() == pytest.approx(outline)


def test_polygons_are_cut_alike_whatever_their_size(tmp_path):
    corners = np.array([[0, 0, 0], [4, 0, 0], [4, 4, 0], [2, 1, 0], [0, 4, 0]], dtype=float)
    found = []
    for size in (1.0, 1e-200, 1e200):
        polygons = Polygons(tmp_path / "mesh.ply")
        polygons.add(np.arange(5)[None])
        found.append(polygons.triangles(size * corners))
    np.testing.assert_array_equal(found[1], found[0])
    np.testing.assert_array_equal(found[2], found[0])
