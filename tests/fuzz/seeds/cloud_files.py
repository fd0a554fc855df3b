"""Clouds and meshes in all their formats and dialects, of some forty points."""

from __future__ import annotations

import io
import struct
from collections.abc import Callable

import numpy as np

from regkit.alignment.starts import read_transform
from regkit.api import load_frame
from regkit.clouds import read_cloud
from regkit.testing.samples import lump_points
from tests.fuzz import oracles
from tests.fuzz.kind import Files, Kind
from tests.fuzz.seeds.solids import BOX_FACES, BOX_VERTICES, glb, off, stl_ascii, stl_binary

POINTS = np.round(lump_points(40) + np.array([0.5, 0.25, 1.5]), 4)
COUNT = len(POINTS)
READABLE = (
    ".ply",
    ".pcd",
    ".pts",
    ".xyz",
    ".csv",
    ".npz",
    ".stl",
    ".obj",
    ".off",
    ".glb",
    ".PLY",
    "",
)


def rows(form: str, points: np.ndarray = POINTS) -> str:
    """A line for each point; ``{0}`` to ``{2}`` are its coordinates."""
    return "".join(form.format(*point) + "\n" for point in points.tolist())


def dialects() -> dict[str, str]:
    """Text clouds by the name of their file."""
    comma = rows("{0};{1};{2}").replace(".", ",")
    return {
        "plain.txt": rows("{} {} {}"),
        "tabs.txt": rows("{}\t{}\t{}"),
        "plain.xyz": rows("{} {} {}"),
        "normals.xyzn": rows("{} {} {} 0 0 1"),
        "colours.xyzrgb": rows("{} {} {} 0.1 0.2 0.3"),
        "header.csv": "x,y,z\n" + rows("{},{},{}"),
        "turned.csv": "z,y,x,intensity\n" + rows("{},{},{},7"),
        "paraview.csv": '"Intensity","Points:0","Points:1","Points:2"\n' + rows("1,{},{},{}"),
        "semicolon.csv": "X;Y;Z\n" + comma,
        "cloudcompare.asc": f"//X Y Z\n{COUNT}\n" + rows("{} {} {}"),
        "comments.txt": "# made\n# x y z\n" + rows("{}, {}, {}"),
        "counted.pts": f"{COUNT}\n" + rows("{} {} {} 12 255 0 7"),
    }


def pcd(data: str, form: str = "<f4", *, organised: bool = False) -> bytes:
    size = np.dtype(form).itemsize
    points = POINTS.copy()
    if organised:
        points[::7] = np.nan
    content = (
        rows("{} {} {}", points).encode() if data == "ascii" else points.astype(form).tobytes()
    )
    return pcd_head(data, size, (COUNT // 4, 4) if organised else (COUNT, 1)) + content


def pcd_of_camera() -> bytes:
    """The image of a pinhole camera, in rows and columns."""
    rows, columns = np.mgrid[:12, :16]
    depth = 1.0 + 0.1 * ((3 * rows + 5 * columns) % 7)
    points = np.stack([(columns - 7.5) * depth / 20, (rows - 5.5) * depth / 20, depth], axis=2)
    points[3, 4] = np.nan
    return pcd_head("binary", 4, (16, 12)) + points.astype("<f4").tobytes()


def pcd_head(data: str, size: int, shape: tuple[int, int]) -> bytes:
    width, height = shape
    text = (
        f"# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE {size} {size} {size}\nTYPE F F F\n"
        f"COUNT 1 1 1\nWIDTH {width}\nHEIGHT {height}\nVIEWPOINT 0 0 0 1 0 0 0\n"
        f"POINTS {width * height}\nDATA {data}\n"
    )
    return text.encode()


def pcd_compressed() -> bytes:
    """LZF may also store bytes as they are, in pieces that a byte with their length precedes."""
    plain = POINTS.T.astype("<f4").tobytes()
    pieces = [plain[at : at + 32] for at in range(0, len(plain), 32)]
    packed = b"".join(bytes([len(piece) - 1]) + piece for piece in pieces)
    head = pcd_head("binary_compressed", 4, (COUNT, 1))
    return head + struct.pack("<II", len(packed), len(plain)) + packed


def ply(data: str, *, faces: bool = False) -> bytes:
    order = ">" if "big" in data else "<"
    vertices = BOX_VERTICES if faces else POINTS
    head = f"ply\nformat {data} 1.0\ncomment made\nelement vertex {len(vertices)}\n"
    head += "property float x\nproperty float y\nproperty float z\n"
    if faces:
        head += f"element face {len(BOX_FACES)}\nproperty list uchar int vertex_indices\n"
    head += "end_header\n"
    if data == "ascii":
        ends = "".join("3 {} {} {}\n".format(*face) for face in BOX_FACES) if faces else ""
        return (head + rows("{} {} {}", vertices) + ends).encode()
    packed = b"".join(struct.pack(f"{order}B3i", 3, *face) for face in BOX_FACES) if faces else b""
    return head.encode() + vertices.astype(f"{order}f4").tobytes() + packed


def obj(quads: bool) -> bytes:
    faces = [(1, 2, 4, 3), (5, 6, 8, 7), (1, 2, 6, 5)] if quads else [f + 1 for f in BOX_FACES]
    text = "# made\no box\n" + "".join("v {} {} {}\n".format(*at) for at in BOX_VERTICES)
    return (text + "".join(f"f {' '.join(map(str, face))}\n" for face in faces)).encode()


def archive() -> bytes:
    stream = io.BytesIO()
    np.savez_compressed(stream, points=POINTS)
    return stream.getvalue()


def matrices() -> list[Files]:
    turned = np.array([[0.0, -1, 0, 0.1], [1, 0, 0, -0.05], [0, 0, 1, 0.08], [0, 0, 0, 1]])
    text = rows("{} {} {} {}", turned)
    return [{"start.txt": form.encode()} for form in (text, text.replace(" ", ", "))]


def _kind(
    name: str, file: str, form: str, seed: Callable[[], bytes], oracle: oracles.Oracle
) -> Kind:
    return Kind(
        f"clouds/{name}",
        lambda: [{file: seed()}],
        {file: form},
        read_cloud,
        oracle,
        suffixes=READABLE,
        weight=0.6,
    )


VERTICES = oracles.counted(rb"^element vertex (\d+)\s*$")
POINTS_LINE = oracles.counted(rb"^POINTS (\d+)\s*$")


def _clouds() -> tuple[Kind, ...]:
    kinds = []
    for file, text in dialects().items():
        oracle = oracles.counted(rb"\A(\d+)\s*$") if file.endswith(".pts") else oracles.lines
        kinds.append(_kind(file, file, "text", text.encode, oracle))
    for name, form, seed in (
        ("pcd-ascii", "text", lambda: pcd("ascii")),
        ("pcd-binary", "binary", lambda: pcd("binary")),
        ("pcd-double", "binary", lambda: pcd("binary", "<f8")),
        ("pcd-organised", "binary", lambda: pcd("binary", organised=True)),
        ("pcd-compressed", "binary", pcd_compressed),
    ):
        kinds.append(_kind(name, "cloud.pcd", form, seed, POINTS_LINE))
    for name, form, seed in (
        ("ply-ascii", "text", lambda: ply("ascii")),
        ("ply-little", "binary", lambda: ply("binary_little_endian")),
        ("ply-big", "binary", lambda: ply("binary_big_endian")),
    ):
        kinds.append(_kind(name, "cloud.ply", form, seed, VERTICES))
    for name, file, form, seed in (
        ("ply-faces", "mesh.ply", "text", lambda: ply("ascii", faces=True)),
        ("ply-faces-binary", "mesh.ply", "binary", lambda: ply("binary_little_endian", faces=True)),
        ("obj", "mesh.obj", "text", lambda: obj(quads=False)),
        ("obj-quads", "mesh.obj", "text", lambda: obj(quads=True)),
        ("off", "mesh.off", "text", off),
        ("stl-ascii", "mesh.stl", "text", stl_ascii),
        ("stl-binary", "mesh.stl", "binary", stl_binary),
        ("glb", "mesh.glb", "glb", glb),
        ("npz", "cloud.npz", "npz", archive),
    ):
        kinds.append(_kind(name, file, form, seed, oracles.cloud))
    organised = Kind(
        "clouds/organised",
        lambda: [{"cloud.pcd": pcd_of_camera()}],
        {"cloud.pcd": "binary"},
        lambda path: load_frame(path).points,
        oracles.cloud,
    )
    matrix = Kind(
        "clouds/matrix",
        matrices,
        {"start.txt": "text"},
        lambda path: read_transform(str(path)),
        oracles.transform,
        weight=2.0,
    )
    return (*kinds, organised, matrix)


CLOUDS = _clouds()
