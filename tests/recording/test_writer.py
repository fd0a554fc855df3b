"""Writing of recordings: what is in the folder is a recording at any time."""

import io
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from regkit.geometry import Camera, Lens
from regkit.interfaces import Dataset, Source
from regkit.observation import Frame, TimedFrame
from regkit.recording import FolderWriter
from regkit.recording.png import png_of
from regkit.system.errors import ConfigError, DataError
from regkit.system.notes import RegkitWarning

CAMERA = Camera(24, 18, 20.0, 21.0, 11.3, 8.9)


def timed(index, scale=1000.0, **changed):
    random = np.random.default_rng(index)
    units = random.integers(0, 65536, size=(18, 24)) * (random.uniform(size=(18, 24)) < 0.8)
    frame = Frame.of_image(units / scale, Lens(CAMERA), place=f"frame {index}")
    return replace(TimedFrame(frame, 100.25 + index / 7.0), **changed)


def writing(folder, name="a walk", scale=1000.0, **options):
    return FolderWriter(folder, name, 30.0, scale, **options)


def write(folder, count, scale=1000.0):
    with writing(folder, scale=scale) as writer:
        for index in range(count):
            writer.add(timed(index, scale))


def read(folder):
    with Source.at(folder).open() as stream:
        return list(stream)


def check(folder, count, scale=1000.0):
    found = read(folder)
    assert len(found) == count
    for index, one in enumerate(found):
        expected = timed(index, scale)
        np.testing.assert_array_equal(one.frame.depth, expected.frame.depth)
        np.testing.assert_array_equal(one.frame.points, expected.frame.points)
        assert one.frame.camera == CAMERA
        assert one.time == expected.time


@pytest.mark.parametrize("shape", [(1, 1), (1, 7), (5, 1), (18, 24), (480, 848)])
def test_image_is_what_another_program_reads(random, shape):
    image = random.integers(0, 65536, size=shape).astype(np.uint16)
    image[random.uniform(size=shape) < 0.3] = 0
    with Image.open(io.BytesIO(png_of(image)), formats=("PNG",)) as read_back:
        assert read_back.mode == "I;16"
        np.testing.assert_array_equal(np.asarray(read_back), image)


@pytest.mark.parametrize("scale", [1000.0, 5000.0, 10000.0, 4000.123])
def test_what_is_written_is_read_to_the_last_bit(tmp_path, scale):
    write(tmp_path / "walk", 4, scale)
    check(tmp_path / "walk", 4, scale)
    with Source.at(tmp_path / "walk").open() as stream:
        assert (stream.name, stream.fps, stream.depth_scale) == ("a walk", 30.0, scale)
    (recording,) = Dataset.parse(
        Dataset.at(tmp_path / "walk"), place="here", field="dataset"
    ).chosen()
    for one, other in zip(recording.frames(), read(tmp_path / "walk"), strict=True):
        np.testing.assert_array_equal(one.depth, other.frame.depth)


def test_recording_is_whole_while_it_is_written(tmp_path):
    """After each frame, and with what a killed process leaves behind the last one."""
    folder = tmp_path / "walk"
    with writing(folder) as writer:
        for index in range(3):
            writer.add(timed(index))
            check(folder, index + 1)
    whole = (folder / "times.csv").read_text()
    (folder / "depth" / ".000003.png.0123456789ab.tmp.png").write_bytes(b"\x89PNG")
    for left in ("3", "3,", "3,100.", "3,100.678\n"):
        (folder / "times.csv").write_text(whole + left)
        check(folder, 3)


def test_frame_after_one_that_could_not_be_written_takes_its_number(tmp_path, monkeypatch):
    def full(*_, **options):
        raise OSError(28, "No space left on device")

    with writing(tmp_path / "walk") as writer:
        writer.add(timed(0))
        with monkeypatch.context() as patch:
            patch.setattr(Path, "write_bytes", full)
            with pytest.raises(DataError, match="No space left"):
                writer.add(timed(5))
        writer.add(timed(1))
    check(tmp_path / "walk", 2)


def test_nothing_is_written_before_the_first_frame(tmp_path):
    writing(tmp_path / "walk").close()
    assert not (tmp_path / "walk").exists()


def test_folder_with_content_is_left_alone(tmp_path):
    (tmp_path / "new").mkdir()
    write(tmp_path / "new", 1)
    (tmp_path / "file").write_text("mine")
    for taken in ("new", "file"):
        with pytest.raises(ConfigError, match=taken):
            writing(tmp_path / taken)
    check(tmp_path / "new", 1)


@pytest.mark.parametrize(
    "name", ["Intel (R) D435: 1/2", "-a", ".hidden", "", "Läufer", "a\nb", "😀", "a\udcffb"]
)
def test_every_name_makes_a_recording(tmp_path, name):
    with writing(tmp_path / "walk", name, source=name) as writer:
        writer.add(timed(0))
    check(tmp_path / "walk", 1)


def test_camera_that_changes_ends_the_recording(tmp_path):
    other = Lens(Camera(12, 9, 10.0, 10.0, 5.5, 4.0))
    with writing(tmp_path / "walk") as writer:
        writer.add(timed(0))
        writer.add(timed(1))
        with pytest.raises(DataError, match=r"24x18 .* 12x9"):
            writer.add(TimedFrame(Frame.of_image(np.ones((9, 12)), other), 200.0))
    check(tmp_path / "walk", 2)


def test_frame_that_cannot_be_recorded_is_refused(tmp_path):
    with writing(tmp_path / "walk") as writer:
        writer.add(timed(0))
        writer.add(timed(1))
        with pytest.raises(DataError, match="cloud"):
            writer.add(TimedFrame(Frame(np.ones((3, 3))), 200.0))
        with pytest.raises(DataError, match="time"):
            writer.add(timed(2, time=0.0))
        writer.add(timed(2))
    check(tmp_path / "walk", 3)


def test_depth_beyond_sixteen_bits_is_left_out_and_told(tmp_path):
    depth = np.full((18, 24), 2.0)
    depth[3, 4], depth[3, 5], depth[3, 6] = 70.0, np.nan, 65.535
    with writing(tmp_path / "walk") as writer, pytest.warns(RegkitWarning, match=r"65\.5"):
        writer.add(TimedFrame(Frame.of_image(depth, Lens(CAMERA)), 0.0))
    image = np.asarray(Image.open(tmp_path / "walk" / "depth" / "000000.png"))
    assert image[3, 4:7].tolist() == [0, 0, 65535]
    assert (np.delete(image.ravel(), [76, 77, 78]) == 2000).all()


TIMES = "frame,time_s\n0,1.0\n1,1.5\n2,1.5\n"


@pytest.mark.parametrize(
    ("text", "place", "word"),
    [
        ("time\n", ":1", "frame,time_s"),
        ("frame,time_s\n0,1.0\n2,1.5\n1,2.0\n", ":3", "2,1.5"),
        ("frame,time_s\n0,1.0\n1,nan\n2,2.0\n", ":3", "nan"),
        ("frame,time_s\n0,1.0\n1,0.5\n2,2.0\n", ":3", "0.5"),
        ("frame,time_s\n0,1.0\n1\n2,2.0\n", ":3", "1"),
        ("frame,time_s\n0,1.0\n1,1e300\n2,2.0\n", ":3", "1e300"),
        ("frame,time_s\n0,1.0\n1,1.5\n", ":4", "frame 2"),
        ("frame,time_s\n0,1.0\n1,1.5", "", "3 frames"),
        ("", ":1", "frame,time_s"),
    ],
)
def test_times_that_are_wrong_are_told_with_their_place(tmp_path, text, place, word):
    folder = tmp_path / "walk"
    write(folder, 3)
    (folder / "times.csv").write_text(TIMES)
    assert [one.time for one in read(folder)] == [1.0, 1.5, 1.5]
    (folder / "times.csv").write_text(text)
    with pytest.raises(DataError) as caught:
        read(folder)
    assert str(caught.value).startswith(f"{folder / 'times.csv'}{place}: ")
    assert word in caught.value.message


def test_frames_without_times_follow_the_frame_rate(tmp_path):
    write(tmp_path / "walk", 3)
    (tmp_path / "walk" / "times.csv").unlink()
    assert [one.time for one in read(tmp_path / "walk")] == [0.0, 1.0 / 30.0, 2.0 / 30.0]


def test_distortion_of_the_camera_file_is_taken_out_of_dataset_and_source(tmp_path):
    folder = tmp_path / "walk"
    write(folder, 2)
    before = read(folder)
    file = folder / "camera.json"
    distortion = {"model": "brown_conrady", "coefficients": [0.4, 0.1, 0.0, 0.0, 0.0]}
    file.write_text(json.dumps({**json.loads(file.read_text()), "distortion": distortion}))
    lens = Lens.read(file)
    expected = [lens.rectified(one.frame.depth) for one in before]
    data = Dataset.parse(Dataset.at(folder), place="here", field="dataset")
    frames = [one.frame for one in read(folder)]
    for found in (frames, list(data.only().frames())):
        for one, depth in zip(found, expected, strict=True):
            np.testing.assert_array_equal(one.depth, depth)
    assert (frames[0].depth != before[0].frame.depth).any()
