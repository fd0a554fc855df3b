"""PCD and NumPy files: any field type, missing measurements, and counts that must agree."""

import io
import zipfile
from pathlib import Path

import numpy as np
import pytest

from regkit.clouds import read_cloud
from regkit.clouds.formats.lzf import decompress
from regkit.clouds.reading import read_measured
from regkit.system.archives import read_arrays
from regkit.system.errors import DataError
from regkit.system.notes import RegkitWarning

CASES = Path(__file__).parents[1] / "cases"


@pytest.fixture
def points(random):
    return random.integers(-100, 100, size=(50, 3)).astype(float)


def pcd(fields, rows, *, data="binary", points=None, extra=""):
    """Returns a PCD file of fields (name, type, size, count) and a structured array."""
    count = len(rows) if points is None else points
    columns = list(zip(*fields, strict=True))
    header = "".join(
        f"{key} {' '.join(map(str, column))}\n"
        for key, column in zip(("FIELDS", "TYPE", "SIZE", "COUNT"), columns, strict=True)
    )
    header = f"# .PCD v0.7\nVERSION 0.7\n{header}WIDTH {count}\nHEIGHT 1\n{extra}POINTS {count}\n"
    body = rows.tobytes()
    if data == "binary_compressed":
        body = b"".join(np.ascontiguousarray(rows[name]).tobytes() for name in rows.dtype.names)
        packed = stored_lzf(body)
        body = np.array([len(packed), len(body)], "<u4").tobytes() + packed
    return f"{header}DATA {data}\n".encode() + body


def stored_lzf(content):
    """Returns LZF data of literals only."""
    parts = [content[at : at + 32] for at in range(0, len(content), 32)]
    return b"".join(bytes([len(part) - 1]) + part for part in parts)


def structured(points, *kinds):
    names = ["pad", "z", "rgb", "x", "normal", "y"]
    dtype = np.dtype([(name, *kind) for name, kind in zip(names, kinds, strict=True)])
    rows = np.zeros(len(points), dtype)
    for axis, column in zip("xyz", points.T, strict=True):
        rows[axis] = column
    return rows


@pytest.mark.parametrize("data", ["binary", "binary_compressed"])
@pytest.mark.parametrize("kind", ["f4", "f8", "i1", "i2", "i4", "i8"])
def test_pcd_of_any_type_and_order_holds_its_points(tmp_path, points, data, kind):
    rows = structured(
        points, ("u1", (3,)), (f"<{kind}",), ("<u4",), (f"<{kind}",), ("<f4", (3,)), (f"<{kind}",)
    )
    letter, size = kind[0].upper(), int(kind[1])
    fields = [
        ("_", "U", 1, 3), ("z", letter, size, 1), ("rgb", "U", 4, 1), ("x", letter, size, 1),
        ("normal", "F", 4, 3), ("y", letter, size, 1),
    ]  # fmt: skip
    path = tmp_path / "a.pcd"
    path.write_bytes(pcd(fields, rows, data=data))
    np.testing.assert_array_equal(read_cloud(path), points)


def test_pcd_of_another_program_holds_the_source():
    with np.load(CASES / "source.npz") as stored:
        source = stored["points"]
    np.testing.assert_allclose(read_cloud(CASES / "05-pcd-double/xyz_8.pcd"), source, atol=1e-6)
    with pytest.warns(RegkitWarning, match="5948 of 7000"):
        points = read_cloud(CASES / "04-pcd-nan/nan_binary.pcd")
    np.testing.assert_allclose(points, source, atol=1e-6)


XYZ = [(axis, "F", 4, 1) for axis in "xyz"]


def xyz(count=3):
    return np.ones(count, [(axis, "<f4") for axis in "xyz"])


@pytest.mark.parametrize(
    ("content", "word"),
    [
        (pcd(XYZ, xyz(), points=4), "holds 3"),
        (pcd(XYZ, xyz(), points=2), "holds 3"),
        (pcd(XYZ, xyz(), points=10**15), "announces 1000000000000000"),
        (pcd(XYZ, xyz(), extra="WIDTH 7\n"), "WIDTH x HEIGHT"),
        (pcd(XYZ, xyz()).replace(b"FIELDS x", b"FIELDS a"), "a y z"),
        (pcd(XYZ, xyz()).replace(b"FIELDS x", b"FIELDS y"), "y y z"),
        (pcd(XYZ, xyz()).replace(b"SIZE 4", b"SIZE 3"), "3 bytes"),
        (pcd(XYZ, xyz()).replace(b"SIZE 4 4", b"SIZE 4"), "SIZE"),
        (pcd(XYZ, xyz()).replace(b"TYPE F", b"TYPE Q"), "Q"),
        (pcd(XYZ, xyz()).replace(b"COUNT 1", b"COUNT 2"), "COUNT 2"),
        (pcd(XYZ, xyz()).replace(b"COUNT 1", b"COUNT -1"), "-1"),
        (pcd(XYZ, xyz()).replace(b"DATA binary", b"DATA zip"), "zip"),
        (pcd(XYZ, xyz())[:60], "DATA"),
        (pcd(XYZ, xyz(), data="binary_compressed")[:-3], "announces"),
        (pcd(XYZ, xyz(), data="binary_compressed", points=900), "900"),
        (pcd(XYZ, xyz(0), data="ascii", points=2) + b"1 2 3\n4 5\n", "2 values"),
        (pcd(XYZ, xyz(0), data="ascii", points=2) + b"1 2 3\n4 5 1,5\n", "1,5"),
        (pcd(XYZ, xyz(0), data="ascii", points=2) + b"1 2 3\n", "holds 1"),
        (pcd(XYZ, np.full(3, np.nan, "f4").view(xyz().dtype)), "all 1"),
        (pcd(XYZ, xyz(0)), "no points"),
    ],
)
def test_pcd_that_is_not_what_it_announces_is_refused(tmp_path, content, word):
    path = tmp_path / "a.pcd"
    path.write_bytes(content)
    with pytest.raises(DataError, match=r"a\.pcd") as caught:
        read_cloud(path)
    assert word in caught.value.message


def test_damaged_compression_never_leaves_its_buffers(random):
    for _ in range(500):
        packed = random.integers(0, 256, size=random.integers(0, 60)).astype(np.uint8)
        assert len(decompress(packed, 100)) <= 100


def test_repeated_bytes_are_decompressed():
    # A literal of one byte, then a copy of nine from one byte back.
    packed = np.array([0, 7, (7 << 5) | 0, 0, 0], np.uint8)
    np.testing.assert_array_equal(decompress(packed, 10), np.full(10, 7))


def test_measured_points_may_be_none(tmp_path):
    np.savez(tmp_path / "a.npz", points=np.full((4, 3), np.nan))
    assert read_measured(tmp_path / "a.npz").shape == (0, 3)
    with pytest.raises(DataError, match="all 4"):
        read_cloud(tmp_path / "a.npz")


def archive(path, header, body=b"", name="points.npy"):
    stream = io.BytesIO()
    text = header.encode() + b" " * (63 - len(header) % 64) + b"\n"
    stream.write(b"\x93NUMPY\x01\x00" + len(text).to_bytes(2, "little") + text + body)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as packed:
        packed.writestr(name, stream.getvalue())
    return path


HEADER = "{{'descr': '{}', 'fortran_order': False, 'shape': {}}}"


@pytest.mark.parametrize(
    ("header", "body", "word"),
    [
        (HEADER.format("<f8", "(1000000000000, 3)"), b"", "needs 24000000000000 bytes"),
        (HEADER.format("<f8", "(10, 3)"), bytes(239), "holds 239"),
        (HEADER.format("<f8", "(-10, 3)"), bytes(240), "needs -240"),
        (HEADER.format("|O", "(1, 3)"), b"x" * 24, "Python objects"),
        (HEADER.format("<c16", "(1, 3)"), bytes(48), "complex128"),
        (HEADER.format("<U1", "(1, 3)"), bytes(12), "<U1"),
        (HEADER.format("<f8", "(3,)"), bytes(24), "(3,)"),
        (HEADER.format("<f8", "(1000000, 12)"), bytes(96_000_000), "more than 100 times"),
        ("(" * 60, b"", "points"),
        ("{}", b"", "points"),
    ],
)
def test_archive_that_asks_for_more_than_it_holds_is_refused(tmp_path, header, body, word):
    path = archive(tmp_path / "a.npz", header, body)
    with pytest.raises(DataError, match=r"a\.npz") as caught:
        read_cloud(path)
    assert word in caught.value.message


def test_arrays_of_an_archive_are_those_that_were_saved(tmp_path, random):
    saved = {"a": random.normal(size=(3, 4)).T, "b": np.array(["x", "yz"]), "c": np.arange(3)}
    np.savez_compressed(tmp_path / "a.npz", **saved)
    read = read_arrays(tmp_path / "a.npz", saved)
    for name, values in saved.items():
        np.testing.assert_array_equal(read[name], values)
    with pytest.raises(DataError, match="no array 'd'"):
        read_arrays(tmp_path / "a.npz", ["d"])


def test_pcd_with_a_part_of_a_point_more_is_refused(tmp_path):
    path = tmp_path / "cloud.pcd"
    header = pcd([(axis, "F", 4, 1) for axis in "xyz"], np.ones((2, 3), "<f4"))
    path.write_bytes(header + b"\n")
    assert len(read_cloud(path)) == 2
    path.write_bytes(header + b"\x00\x01")
    with pytest.raises(DataError, match="2 bytes more"):
        read_cloud(path)
