"""Damaged files: whatever the bytes, the answer is points or a RegkitError, and soon."""

import importlib.util
import time
import warnings
from pathlib import Path

import numpy as np
import pytest

from regkit.alignment.starts import read_transform
from regkit.clouds import read_cloud
from regkit.geometry.camera import Camera
from regkit.observation.depth_image import read_depth
from regkit.system.errors import RegkitError
from regkit.system.notes import RegkitWarning

CASES = Path(__file__).parents[1] / "cases"
SLOWEST = 2.0
"""Longest processor time for one small file [s]."""


def beside(name):
    """Returns a test module of this folder, for its files."""
    path = Path(__file__).with_name(f"{name}.py")
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def originals():
    """Returns small valid files by name."""
    meshes, binary = beside("test_meshes"), beside("test_binary_clouds")
    rows = b"".join(b"%d.5,%d,-3e2\n" % (n, n * n) for n in range(12))
    archive = CASES / "11-intrinsics" / "walk_rows_3x3"
    return {
        "a.csv": b"x,y,z\n" + rows,
        "b.csv": b"X;Y;Z;label\n"
        + rows.replace(b",", b";").replace(b".", b",").replace(b"\n", b";a\n"),
        "a.txt": b"//X Y Z\n12\n" + rows.replace(b",", b" "),
        "a.pcd": binary.pcd(binary.XYZ, binary.xyz(20)),
        "b.pcd": binary.pcd(binary.XYZ, binary.xyz(20), data="binary_compressed"),
        "c.pcd": binary.pcd(binary.XYZ, binary.xyz(0), data="ascii", points=2) + b"1 2 3\n4 5 6\n",
        "a.obj": (meshes.V + "f 1 2 3 4\nf -1 -2 -3\n").encode(),
        "a.off": b"OFF\n4 1 0\n" + meshes.OFF.encode(),
        "a.ply": (meshes.PLY.format(2) + "3 0 1 2\n3 0 2 3\n").encode(),
        "b.ply": meshes.binary_ply("big", faces=[(0, 1, 2), (0, 1, 2, 3)]),
        "a.stl": meshes.SOLID.encode(),
        "b.stl": meshes.stl(),
        "a.gltf": meshes.gltf().encode(),
        "camera.json": (archive / "camera.json").read_bytes(),
        "depth.png": (archive / "depth" / "000000.png").read_bytes(),
        "T.start": b"1 0 0 1\n0 1 0 2\n0 0 1 3\n0 0 0 1\n",
    }


WORDS = (
    b"",
    b"\0",
    b"\xff",
    b"-1",
    b"0",
    b"nan",
    b"1e400",
    b"9" * 30,
    b"4294967296",
    b"\n",
    b",",
    b"{",
)


def damaged(content, random):
    """Returns the content after one to four random changes."""
    changed = bytearray(content)
    for _ in range(random.integers(1, 5)):
        at = int(random.integers(0, len(changed) + 1))
        end = at + int(random.integers(0, 9))
        match random.integers(0, 5):
            case 0:
                changed[at:end] = random.bytes(end - at)
            case 1:
                changed[at:end] = WORDS[random.integers(0, len(WORDS))]
            case 2:
                del changed[at:]
            case 3:
                changed[at:at] = changed[at : at + 40]
            case _ if at < len(changed):
                changed[at] ^= 1 << int(random.integers(0, 8))
    return bytes(changed)


def read(path):
    """Reads a file by its name."""
    readers = {"camera.json": Camera.read, "depth.png": read_depth}
    if path.suffix == ".start":
        return read_transform(str(path))
    return readers.get(path.name, read_cloud)(path)


def fuzzed(folder, count):
    random = np.random.default_rng(14)
    for name, content in originals().items():
        path = folder / name
        path.write_bytes(content)
        read(path)
        for _ in range(count):
            path.write_bytes(damaged(content, random))
            begun = time.process_time()
            try:
                found = read(path)
            except RegkitError as error:
                found = str(error)
            if isinstance(found, np.ndarray):
                assert np.isfinite(found).all()
            else:
                assert len(str(found)) < 1000
            assert time.process_time() - begun < SLOWEST


def test_damaged_file_gives_points_or_an_error(tmp_path):
    with warnings.catch_warnings(action="ignore", category=RegkitWarning):
        fuzzed(tmp_path, 40)


@pytest.mark.long
def test_many_damaged_files_give_points_or_errors(tmp_path):
    with warnings.catch_warnings(action="ignore", category=RegkitWarning):
        fuzzed(tmp_path, 1000)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        # The line ends are lost, or none that a text file has.
        ("one_row.xyz", " ".join(["0.5 0.25 1.5"] * 40)),
        ("one_row.txt", "\v".join(["0.5 0.25 1.5"] * 40)),
        ("digits.txt", "0.5 0.25 1.5\n0.5 0.25 \u0663\n"),
        ("statement.obj", "v 0 0 0\nv 1 0 0\n1 2 3\nv 0 1 0\nf 1 2 3\n"),
        ("version.ply", "ply\nformat ascii 7\nelement vertex 1\nproperty float x\n"
         "property float y\nproperty float z\nend_header\n1 2 3\n"),
        ("rest.pcd", "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\n"
         "POINTS 1\nDATA binary\n" + "AAAA" * 3 + "B"),
    ],
)  # fmt: skip
def test_text_that_is_nearly_a_cloud_is_refused(tmp_path, name, content):
    path = tmp_path / name
    path.write_text(content, encoding="utf-8")
    with pytest.raises(RegkitError, match=name):
        read_cloud(path)
