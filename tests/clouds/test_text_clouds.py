"""Text clouds: columns by name, one delimiter and one decimal sign in the whole file."""

from pathlib import Path

import numpy as np
import pytest

from regkit.clouds import read_cloud
from regkit.system.errors import DataError
from regkit.system.notes import RegkitWarning

CASES = Path(__file__).parents[1] / "cases"
POINTS = [[1.5, 2.5, 3.5], [-4.25, 5.0, 6.0]]


@pytest.fixture
def read(tmp_path):
    def reader(content, name="cloud.csv"):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return read_cloud(path)

    return reader


@pytest.mark.parametrize(
    ("name", "folder"),
    [
        ("s_points.csv", "01-csv-columns"),
        ("s_zyx.csv", "01-csv-columns"),
        ("s_mm.csv", "02-decimal-comma"),
        ("cc.txt", "03-cloudcompare"),
        ("cc.asc", "03-cloudcompare"),
        ("cloud.pts", "07-pts"),
    ],
)
def test_file_of_another_program_holds_the_source(name, folder):
    with np.load(CASES / "source.npz") as stored:
        source = stored["points"]
    scale = 1000.0 if "mm" in name else 1.0
    points = read_cloud(CASES / folder / name)
    np.testing.assert_allclose(points / scale, source, atol=1e-4)


@pytest.mark.parametrize(
    "content",
    [
        "x,y,z\n1.5,2.5,3.5\n-4.25,5,6\n",
        "X;Y;Z\n1,5;2,5;3,5\n-4,25;5;6\n",
        "z y x\n3.5 2.5 1.5\n6 5 -4.25\n",
        '"Intensity","Points:2","Points:0","Points:1"\n9,3.5,1.5,2.5\n9,6,-4.25,5\n',
        "Points_0\tPoints_1\tPoints_2\n1.5\t2.5\t3.5\n-4.25\t5\t6\n",
        "//X Y Z R G B\n2\n1.5 2.5 3.5 1 2 3\n-4.25 5 6 1 2 3\n",
        "# x y z\n1.5 2.5 3.5\n-4.25 5 6\n",
        "# z, y, x\n3.5, 2.5, 1.5\n6, 5, -4.25\n",
        "label,x,y,z\nleft hand,1.5,2.5,3.5\nfoot,-4.25,5,6\n",
        'note,x,y,z\n"a, b",1.5,2.5,3.5\n"c",-4.25,5,6\n',
        '"x","y","z"\n"1,5","2,5","3,5"\n"-4,25","5,0","6,0"\n',
        "px py pz nx ny nz\n1.5 2.5 3.5 0 0 1\n-4.25 5 6 0 0 1\n",
        "pos_x,pos_y,pos_z\n1.5,2.5,3.5\n-4.25,5,6\n",
        "position.z,position.y,position.x\n3.5,2.5,1.5\n6,5,-4.25\n",
        "X_coord;Y_coord;Z_coord\n1.5;2.5;3.5\n-4.25;5;6\n",
        "Northing,Easting,Height\n2.5,1.5,3.5\n5,-4.25,6\n",
        "Points_m_XYZ:0,Points_m_XYZ:1,Points_m_XYZ:2,X,Y,Z\n9,9,9,1.5,2.5,3.5\n8,8,8,-4.25,5,6\n",
        "sep=;\nx;y;z\n1,5;2,5;3,5\n-4,25;5;6\n",
        "x,y,z,\n1.5,2.5,3.5,\n-4.25,5,6,\n",
        "x,y,z\n1.5,2.5,3.5,\n-4.25,5,6,\n",
        ",x,y,z\n0,1.5,2.5,3.5\n1,-4.25,5,6\n",
        "x|y|z\n1.5|2.5|3.5\n-4.25|5|6\n",
        "x y z\n 1.5D+00 2.5d0 3.5\n -0.425D+01 5 6\n",
        "x, y, z\n1.5, 2.5, 3.5\n-4.25, 5.0, 6.0\n",
        "1.5, 2.5, 3.5\n-4.25, 5.0, 6.0",
        "1.5\t2.5 3.5\n-4.25 5\t6\n",
        "1,5 2,5 3,5\n-4,25 5 6\n",
        "1,5\t2,5\t3,5\n-4,25\t5\t6\n",
        "1.5;2.5;3.5\r\n-4.25;5;6\r\n",
        "1.5 2.5 3.5\r-4.25 5 6\r",
        "\n\n# a\n% b\n// c\n1.5 2.5 3.5 # first\n\n-4.25 5 6\n# end\n",
        "1.5 2.5 3.5\n\u22124.25 5 6\n",
        "x,y,z\n+1.5,2.50e0,.35E1\n-4.25,5.,6\n",
        "# columns: z x y i\n3.5 1.5 2.5 9\n6 -4.25 5 9\n",
        "# made with x y z inside\n1.5 2.5 3.5\n-4.25 5 6\n",
        "x,y,z\n1.5,2.5,3.5\n-4.25,5,6\n\x1a",
        "x [m],y [m],z [m]\n1.5,2.5,3.5\n-4.25,5,6\n",
        "x(m);y(m);z(m)\n1,5;2,5;3,5\n-4,25;5;6\n",
        "x,y,z\nm,m,m\n1.5,2.5,3.5\n-4.25,5,6\n",
        "x y z\n1,1.5,2.5\n".replace("1,1.5,2.5", "1.5,2.5,3.5\n-4.25,5,6"),
        "x;y;z\n1,5;2,5;3,5\n-4,25;5;6\n".encode("utf-16"),
        "x;y;z\n1,5;2,5;3,5\n-4,25;5;6\n".encode("utf-8-sig"),
        "x,y,z,H\xf6he\n1.5,2.5,3.5,0\n-4.25,5,6,0\n".encode("latin-1"),
    ],
)
def test_columns_delimiter_and_decimal_sign_are_found(read, content):
    np.testing.assert_allclose(read(content), POINTS)


@pytest.mark.parametrize(
    ("content", "line", "word"),
    [
        ("a,b,c\n1,2,3\n", 1, "a, b, c"),
        ("lat,lon,alt\n1,2,3\n", 1, "lat, lon, alt"),
        ("x,y\n1,2,3\n", 1, "x, y"),
        ("x,y,z,i\n1,2,3\n", 1, "4 columns"),
        ('"x" "y" "z"\n"1" 0.1 0.2 0.3\n"2" 0.1 0.2 0.3\n', 1, "3 columns"),
        ("# i x y z\n9 1 2 3 9\n", 1, "4 columns"),
        ("x [mm] y [mm] z [mm]\n1 2 3 4 5 6\n", 1, "3 columns"),
        ("x,y,z,x\n1,2,3,4\n", 1, "'x'"),
        ("x,X,y,z\n1,2,3,4\n", 1, "'X'"),
        ("x [mm],y [m],z [m]\n1,2,3\n", 1, "units"),
        ("x [px],y [px],z [px]\n1,2,3\n", 1, "px"),
        ("x,y,z\n1,2,3\n4;5;6\n", 3, "1 cells"),
        ("x,y,z\n1,2,3\n4,5\n", 3, "2 cells"),
        ("x,y,z\n1,2,3\n4,5,6,7\n", 3, "4 cells"),
        ("x,y,z\n1,5,2,5,3,5\n", 1, "6"),
        ("x,y,z\n1,2,abc\n", 2, ""),
        ("x,y,z\n1,2,3\n1,2,0x1F\n", 3, "0x1F"),
        ("x,y,z\n1,2,3\n1,2,1_000\n", 3, "1_000"),
        ("x,y,z\n1,2,3\n1,2,1e999\n", 3, "1e999"),
        ("x;y;z\n1,5;2;3\n1.5;2;3\n", 2, "point in line 3"),
        ("x;y;z\n1,234;2,345;3,456\n", 2, "1,234"),
        ('x,y,z\n"1,234.5","2,345.6","3,456.7"\n', None, "1,234.5"),
        ("x;y;z\n1.234.567;2;3\n1;2;3\n", None, "1.234.567"),
        ("x;y;z\n1;2;3\n1'234;2;3\n", 3, "1'234"),
        ("1,5,2,5,3,5\n1,7,2,8,3,9\n", 1, "1,5"),
        ("1,234.5,2,345.6,3,456.7\n1,234.6,2,345.6,3,456.7\n", 1, "1,234.5"),
        ("1 234,5 2 345,6 3 456,7\n1 234,5 2 345,6 3 456,7\n", 1, "1 234.5"),
        ("1\xa0234,5 2,5 3,5\n1\xa0234,5 2,5 3,5\n", None, ""),
        ("0,1,2\n0.5,0.6,0.7\n0.5,0.6,0.8\n", 1, "numbers of the columns"),
        (",0,1,2\n0,0.5,0.6,0.7\n1,0.5,0.6,0.8\n", 1, ""),
        ("".join(f"{n} 0.{n} 0.2 0.3\n" for n in range(12)), 1, "numbers the rows"),
        ("//X Y Z\n3\n1 2 3\n4 5 6\n", 2, "announces 3"),
        ("1 2 3\n2\n4 5 6\n7 8 9\n", 2, "lone"),
        ("1 2 3\nx y z\n4 5 6\n", 2, ""),
        ("3\nmade by hand\n1 2 3\n4 5 6\n7 8 9\n", 2, "made, by, hand"),
        ("3\nwater\nO 1 2 3\nH 4 5 6\nH 7 8 9\n", 2, "water"),
        ("ncols 4\nnrows 2\n1 2 3 4\n5 6 7 8\n", 2, "nrows"),
        ("", None, "no points"),
        ("x,y,z\n", None, "no points"),
        ("1 2\n3 4\n", None, "no points"),
        (b"1 2 3\n4 5\x006\n", 2, "NUL"),
        (b"1 2 3\x0b4 5 6\x0b7 8 9\n", 1, "end of a line"),
        ("0 0 0\n1 2 3\u20284 5 6\n".encode(), 2, "end of a line"),
        ("1 2 3\n4 5 6\n".encode("utf-16-le"), 1, "NUL"),
        (b"\xff\xfe1\x00 ", None, ""),
        ("x,y,z\nnan,1,2\n,1,2\n", None, "all 2"),
        ("1 2 3\n1e13 2 3\n", None, "1e+12"),
        ("1.02.03.0\n1.02.03.0\n", None, "no points"),
    ],
)
@pytest.mark.filterwarnings("ignore::regkit.system.notes.RegkitWarning")
def test_file_that_can_be_misread_is_refused_with_its_line(read, content, line, word):
    with pytest.raises(DataError) as caught:
        read(content)
    assert word in caught.value.message
    if line is not None:
        assert caught.value.place.endswith(f"cloud.csv:{line}")


@pytest.mark.parametrize(
    ("content", "expected", "told"),
    [
        ("x,y,z\n1,2,3\nnan,5,6\n,,\n7,8,9\n", [[1, 2, 3], [7, 8, 9]], "2 of 4"),
        ("1 2 3\n4 inf 6\n4 -Infinity 6\n", [[1, 2, 3]], "2 of 3"),
        ("1 2 3\n-nan(ind) 1.#QNAN NA\n", [[1, 2, 3]], "1 of 2"),
        ("x [mm],y [mm],z [mm]\n1,2,3\n", [[0.001, 0.002, 0.003]], "mm"),
        ("x_cm;y_cm;z_cm\n1,5;2;3\n", [[0.015, 0.02, 0.03]], "cm"),
        ("x;y;z\nmm;mm;mm\n1,5;2;3\n", [[0.0015, 0.002, 0.003]], "mm"),
        ("x [mm] y [mm] z [mm]\n1 2 3\n", [[0.001, 0.002, 0.003]], "mm"),
        ("# z (mm) x (mm) y (mm)\n3 1 2\n", [[0.001, 0.002, 0.003]], "mm"),
        ("1 2 3 7\n4 5 6 8\n", [[1, 2, 3], [4, 5, 6]], "first three of 4"),
        ("x y z\n1 2 3\nx y z\n4 5 6\n", [[1, 2, 3], [4, 5, 6]], "repeated"),
        ("Scan of Monday\nDevice: B\nx,y,z\n1,2,3\n", [[1, 2, 3]], "passed over"),
    ],
)
def test_what_is_assumed_or_dropped_is_told(read, content, expected, told):
    with pytest.warns(RegkitWarning, match=told):
        points = read(content)
    np.testing.assert_allclose(points, expected)


def test_scans_of_a_pts_file_are_joined(read):
    content = "2\n1 2 3 -5 0 0 0\n4 5 6 -5 0 0 0\n1\n7 8 9 -5 0 0 0\n"
    np.testing.assert_array_equal(read(content, "a.pts"), [[1, 2, 3], [4, 5, 6], [7, 8, 9]])
    with pytest.raises(DataError, match="announces 2"):
        read(content.replace("4 5 6 -5 0 0 0\n", ""), "a.pts")


def test_rows_are_equal_whether_numpy_reads_them_or_not(read, random):
    points = random.normal(size=(200, 3)) * 10.0 ** random.integers(-9, 9, size=(200, 1))
    rows = "".join(",".join(map(repr, row)) + "\n" for row in points.tolist())
    plain = read("x,y,z\n" + rows)
    np.testing.assert_array_equal(plain, points)
    # A quote sends the file to the loop.
    np.testing.assert_array_equal(read('x,y,z\n"1",2,3\n' + rows)[1:], points)


@pytest.mark.parametrize(
    ("content", "scale"),
    [
        ("x [millimeters],y [millimeters],z [millimeters]\n1.5,2.5,3.5\n-4.25,5,6\n", 0.001),
        ("# units: mm\nx,y,z\n1.5,2.5,3.5\n-4.25,5,6\n", 0.001),
        ("# All units are in centimetres.\n1.5,2.5,3.5\n-4.25,5,6\n", 0.01),
    ],
)
def test_unit_that_a_file_states_is_converted_and_told(read, content, scale):
    with pytest.warns(RegkitWarning, match="unit"):
        points = read(content)
    np.testing.assert_allclose(points, np.multiply(POINTS, scale))


@pytest.mark.parametrize("mark", ["-9999,-9999,-9999", "1,2,-99999", "0,0,0"])
def test_points_that_look_like_missing_measurements_are_told(read, mark):
    with pytest.warns(RegkitWarning, match="missing measurement"):
        assert len(read(f"x,y,z\n1.5,2.5,3.5\n{mark}\n{mark}\n")) == 3
