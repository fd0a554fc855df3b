"""``regkit record``: what is written, when it ends, and what it refuses."""

import signal

import numpy as np
import pytest
from bags import WALK, image_row, walk_images, walk_rows, write_bag
from places import ROOT

from regkit.interfaces import Source
from regkit.system.errors import DataError

CAMERA = ("--plugin", ROOT / "tests" / "support" / "slow_camera.py")
COUNT = 5


def frames_of(path):
    with Source.at(path).open() as stream:
        return list(stream)


def depths(path):
    return [frame.frame.depth for frame in frames_of(path)]


def test_record_writes_what_the_source_yields(regkit, tmp_path):
    bag = write_bag(tmp_path / "walk", "mcap file", walk_rows(COUNT))
    ended = regkit("record", bag, tmp_path / "out")
    assert (ended.code, ended.err) == (0, "")
    assert f"{COUNT} frames" in ended.out
    expected = depths(WALK)[:COUNT]
    np.testing.assert_array_equal(depths(tmp_path / "out"), expected)
    again = regkit("record", tmp_path / "out", tmp_path / "again")
    assert again.code == 0
    for one, other in zip(frames_of(tmp_path / "again"), frames_of(bag), strict=True):
        np.testing.assert_array_equal(one.frame.points, other.frame.points)
        assert one.time == other.time


@pytest.mark.parametrize(
    ("limits", "count"),
    [(("--frames", 3), 3), (("--seconds", 0.1), 3), (("--frames", 9, "--seconds", 0.1), 3)],
)
def test_record_ends_at_its_limits(regkit, tmp_path, limits, count):
    ended = regkit("record", WALK, tmp_path / "out", *limits)
    assert ended.code == 0
    assert len(frames_of(tmp_path / "out")) == count


def test_record_sets_fields_of_the_source(regkit, tmp_path):
    other = [image_row(image, n, topic="/b/image") for n, image in enumerate(walk_images(2))]
    bag = write_bag(tmp_path / "two", "mcap", [*walk_rows(COUNT), *other])
    settings = ("--set", "topic=/b/image", "--set", "camera_info=/camera/depth/camera_info")
    assert regkit("record", bag, tmp_path / "out", *settings).code == 0
    assert len(frames_of(tmp_path / "out")) == 2
    wrong = regkit("record", bag, tmp_path / "x", "--set", "topik=/b/image")
    assert wrong.code == 1
    assert wrong.err.startswith("error: --set topik=/b/image: source.topik: no such field")


def test_record_leaves_out_damaged_frames_and_tells_them(regkit, tmp_path):
    ended = regkit(
        "record", "slow:", tmp_path / "out", "--frames", 4, "--set", "damaged=2", *CAMERA
    )
    assert ended.code == 0
    assert "a frame that is torn" in ended.err
    assert "1 damaged" in ended.out
    assert [depth[0, 0] for depth in depths(tmp_path / "out")] == [1.0, 1.01, 1.03, 1.04]


@pytest.mark.parametrize(("fault", "told"), [("lost", "unplugged"), ("resized", "12x9")])
def test_record_keeps_what_it_has_if_the_camera_is_lost_or_changes(regkit, tmp_path, fault, told):
    ended = regkit("record", "slow:", tmp_path / "out", "--set", f"{fault}=3", *CAMERA)
    assert ended.code == 1
    assert ended.err.startswith("error: ")
    assert told in ended.err
    assert "3 frames" in ended.out
    assert len(frames_of(tmp_path / "out")) == 3


@pytest.mark.parametrize("taken", ["folder", "file"])
def test_record_writes_over_nothing(regkit, tmp_path, taken):
    path = tmp_path / taken
    if taken == "folder":
        path.mkdir()
        path = (path / "mine").parent
        (path / "mine").write_text("mine")
    else:
        path.write_text("mine")
    ended = regkit("record", "slow:", path, *CAMERA)
    assert ended.code == 1
    assert ended.err.startswith(f"error: {path}: ")
    left = [one.read_text() for one in tmp_path.rglob("*") if one.is_file()]
    assert left == ["mine"]


def test_record_without_a_frame_is_an_error_and_writes_nothing(regkit, tmp_path):
    ended = regkit("record", WALK, tmp_path / "out", "--seconds", 0.0)
    assert ended.code == 1
    assert "no frame" in ended.err
    assert not (tmp_path / "out").exists()


def test_clouds_are_not_recorded(regkit, tmp_path):
    ended = regkit("record", WALK.parent / "mannequin", tmp_path / "out")
    assert ended.code == 1
    assert "cloud" in ended.err


@pytest.mark.parametrize(("pressed", "code"), [(signal.SIGINT, 130), (signal.SIGKILL, -9)])
def test_recording_that_is_ended_at_any_time_can_be_read(started, tmp_path, pressed, code):
    out = tmp_path / "out"
    run = started("record", "slow:", out, *CAMERA)
    run.wait_for(out / "depth" / "000003.png")
    run.process.send_signal(pressed)
    told, _ = run.process.communicate()
    assert run.process.returncode == code
    found = depths(out)
    assert len(found) >= 4
    for number, depth in enumerate(found):
        assert (np.abs(depth - (1.0 + 0.01 * number)) < 6e-4).all()
    assert (f"{len(found)} frames" in told) is (pressed is signal.SIGINT)
    assert not list(out.rglob("*.tmp*")) or pressed is signal.SIGKILL


def test_damaged_frame_in_a_folder_does_not_hide_the_others(regkit, tmp_path):
    regkit("record", WALK, tmp_path / "out", "--frames", 3)
    image = tmp_path / "out" / "depth" / "000001.png"
    image.write_bytes(image.read_bytes()[:200])
    with Source.at(tmp_path / "out").open() as stream:
        assert stream.read() is not None
        with pytest.raises(DataError, match=r"000001\.png"):
            stream.read()
        assert stream.read() is not None
        assert stream.read() is None
