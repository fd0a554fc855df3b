"""Markers of a motion-capture system: their files, and their frames."""

import sys

import numpy as np
import pytest
from marker_files import write_trc

from regkit.interfaces import Dataset
from regkit.recording.markers import read_trajectories
from regkit.system.errors import DataError, DependencyError, RegkitError

NAMES = ("L.ASIS", "r_knee")


def places(frames=3):
    found = np.random.default_rng(0).uniform(-1.0, 1.0, (frames, 2, 3))
    found[1, 1] = np.nan
    return found


@pytest.mark.parametrize(("unit", "scale"), [("m", 1.0), ("mm", 1000.0), ("cm", 100.0)])
def test_trc_is_read_in_metres_whatever_its_unit(tmp_path, unit, scale):
    path = write_trc(tmp_path / "a.trc", NAMES, places(), fps=120.0, unit=unit, scale=scale)
    found = read_trajectories(path)
    assert found.names == NAMES
    assert found.fps == 120.0
    np.testing.assert_allclose(found.positions, places(), atol=1e-6)


def test_markers_are_points_and_landmarks_in_the_camera_frame(tmp_path):
    path = write_trc(tmp_path / "walk.trc", NAMES, places())
    for up, turned in (("y", [1, -2, -3]), ("z", [1, -3, 2])):
        data = {"kind": "markers", "path": str(path), "up": up, "frames": 2}
        recording = Dataset.parse(data, place="test", field="dataset").only()
        first, second = recording.frames()
        own = places()[0][:, np.abs(turned) - 1] * np.sign(turned)
        np.testing.assert_allclose(first.points, own, atol=1e-6)
        np.testing.assert_allclose(first.landmarks.positions, own, atol=1e-6)
        assert len(second.points) == 1
        assert np.isnan(second.landmarks.positions[1]).all()
        assert recording.name == "walk"
        assert list(recording.input_files()) == [path]


def test_trc_without_the_last_tabs_has_unmeasured_markers(tmp_path):
    path = write_trc(tmp_path / "a.trc", NAMES, places())
    path.write_text("\n".join(line.rstrip("\t") for line in path.read_text().split("\n")))
    np.testing.assert_allclose(read_trajectories(path).positions, places(), atol=1e-6)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("PathFileType", "Path", r":1: "),
        ("100\t100\t3\t2\tm", "100\t100\t3\t2\tfeet", r":3: .*feet"),
        ("100\t100\t3\t2\tm", "fast\t100\t3\t2\tm", r":3: .*fast"),
        ("100\t100\t3\t2\tm", "100\t100\t4\t2\tm", r"NumFrames is 4"),
        ("r_knee", "L.ASIS", r"two markers"),
        ("\n2\t", "\ntwo\t", r":8: not a row"),
        ("\n3\t0.0200\t", "\n3\t0.0200\t1.0\t", r":9: .*9 cells"),
    ],
)
def test_damaged_trc_is_refused_at_its_line(tmp_path, old, new, said):
    path = write_trc(tmp_path / "a.trc", NAMES, places())
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(DataError, match=said):
        read_trajectories(path)


def test_c3d_names_what_reads_it(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "ezc3d", None)
    (tmp_path / "a.c3d").write_bytes(b"\2\x50")
    with pytest.raises(DependencyError, match=r"regkit\[markers\]"):
        read_trajectories(tmp_path / "a.c3d")
    with pytest.raises(RegkitError, match=r"\.trc"):
        read_trajectories(tmp_path / "a.txt")


def test_c3d_is_read_through_ezc3d_and_a_cut_one_is_refused(tmp_path):
    library = pytest.importorskip("ezc3d", reason="ezc3d is an optional extra")
    content, path = library.c3d(), tmp_path / "a.c3d"
    points = np.ones((4, 2, 3))
    points[:3] = 1000.0 * np.nan_to_num(places()).transpose(2, 1, 0)
    about = content["parameters"]["POINT"]
    about["RATE"]["value"], about["UNITS"]["value"] = [100], ["mm"]
    about["LABELS"]["value"] = NAMES
    content["data"]["points"] = points
    content.write(str(path))
    found = read_trajectories(path)
    np.testing.assert_allclose(found.positions, np.nan_to_num(places()), atol=1e-6)
    whole = path.read_bytes()
    # The last block holds 96 bytes of frames.
    for length in (4, 700, len(whole) - 480):
        path.write_bytes(whole[:length])
        with pytest.raises(DataError, match=r"cut off|ends within"):
            read_trajectories(path)
