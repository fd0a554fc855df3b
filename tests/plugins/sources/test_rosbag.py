"""Bags: the shipped walk in each of their formats, and what is wrong with others."""

import sys

import numpy as np
import pytest
from bags import (
    CAMERA,
    FORMATS,
    INFO,
    START,
    TOPIC,
    WALK,
    camera_row,
    compressed_row,
    image_row,
    walk_images,
    walk_rows,
    write_bag,
)

from regkit.geometry import Camera, Lens
from regkit.geometry.distortion import BrownConrady, KannalaBrandt
from regkit.interfaces import Source
from regkit.system.errors import (
    ConfigError,
    DataError,
    DependencyError,
    RegkitError,
    SourceLostError,
)
from regkit_plugins.sources.rosbag import Rosbag

COUNT = 4


def frames_of(path, **fields):
    """Returns all frames of a source, and its stream."""
    with Source.at(path, **fields).open() as stream:
        return list(iter(stream.read, None)), stream


def refusal(path, **fields):
    """Returns the error of opening or reading a source."""
    with pytest.raises(RegkitError) as caught:
        frames_of(path, **fields)
    return caught.value


@pytest.fixture(scope="module")
def walk():
    """The first frames of the shipped walk, as its folder holds them."""
    return frames_of(WALK)[0][:COUNT]


def check_walk(found, walk):
    assert len(found) == COUNT
    for one, other in zip(found, walk, strict=True):
        np.testing.assert_array_equal(one.frame.depth, other.frame.depth)
        np.testing.assert_array_equal(one.frame.points, other.frame.points)
        assert one.frame.camera == other.frame.camera


@pytest.mark.parametrize("kind", FORMATS)
def test_walk_in_a_bag_is_the_walk_in_its_folder(tmp_path, walk, kind):
    path = write_bag(tmp_path / "walk", kind, walk_rows(COUNT))
    assert isinstance(Source.at(path), Rosbag)
    found, stream = frames_of(path)
    check_walk(found, walk)
    assert (stream.name, stream.length, stream.fps) == ("walk", COUNT, 30.0)
    times = [one.time for one in found]
    np.testing.assert_allclose(times, START + np.arange(COUNT) / 30.0, rtol=0, atol=1e-6)


@pytest.mark.parametrize("kind", ["mcap", "bag"])
@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("padding", [0, 16])
def test_bytes_of_any_order_and_padding_are_the_same_image(tmp_path, walk, kind, order, padding):
    images = [image.astype(f"{order}u2") for image in walk_images(COUNT)]
    rows = [image_row(image, n, padding=padding) for n, image in enumerate(images)]
    check_walk(frames_of(write_bag(tmp_path / "walk", kind, [camera_row(), *rows]))[0], walk)


def test_compressed_depth_is_the_same_image(tmp_path, walk):
    rows = [compressed_row(image, n) for n, image in enumerate(walk_images(COUNT))]
    check_walk(frames_of(write_bag(tmp_path / "walk", "mcap", [camera_row(), *rows]))[0], walk)
    both = [*walk_rows(COUNT), *rows]
    found, _ = frames_of(write_bag(tmp_path / "both", "mcap", both))
    check_walk(found, walk)


@pytest.mark.parametrize("order", ["<", ">"])
def test_metres_are_kept_and_what_is_no_measurement_is_zero(tmp_path, order):
    image = np.full((144, 176), 1.5, dtype=f"{order}f4")
    image[10, 20:24] = np.nan, np.inf, -np.inf, -1.0
    image[11, 20] = 2.0 + 2.0**-20
    (one,), _ = frames_of(write_bag(tmp_path / "m", "db3", [camera_row(), image_row(image, 0)]))
    assert not one.frame.depth[10, 20:24].any()
    assert one.frame.depth[11, 20] == 2.0 + 2.0**-20
    assert one.frame.depth.sum() == pytest.approx(1.5 * (144 * 176 - 5) + 2.0, abs=1e-3)


def test_units_of_whole_numbers_are_a_field(tmp_path):
    image = np.full((144, 176), 5000, dtype="u2")
    path = write_bag(tmp_path / "u", "mcap", [camera_row(), image_row(image, 0)])
    (one,), stream = frames_of(path, depth_scale=5000.0)
    assert (one.frame.depth == 1.0).all()
    assert stream.depth_scale == 5000.0


@pytest.mark.parametrize(
    ("model", "coefficients", "distortion"),
    [
        ("plumb_bob", (0.5, -0.2, 1e-2, 2e-2, 0.05), BrownConrady),
        ("rational_polynomial", (0.9, -2.0, 1e-2, -1e-2, 1.0, 0.3, -1.9, 0.9), BrownConrady),
        ("equidistant", (0.01, -0.02, 0.003, -0.001), KannalaBrandt),
    ],
)
@pytest.mark.parametrize("kind", ["mcap", "bag"])
def test_distortion_of_the_camera_is_taken_out(tmp_path, kind, model, coefficients, distortion):
    (image,) = walk_images(1)
    rows = [camera_row(model=model, coefficients=coefficients), image_row(image, 0)]
    (one,), _ = frames_of(write_bag(tmp_path / "walk", kind, rows))
    expected = Lens(CAMERA, distortion(coefficients)).rectified(image / 1000.0)
    np.testing.assert_array_equal(one.frame.depth, expected)
    assert (one.frame.depth != image / 1000.0).any()


def test_rectified_images_have_the_matrix_p_and_no_distortion(tmp_path):
    (image,) = walk_images(1)
    p = [240.0, 0, 88.0, 0, 0, 241.0, 72.0, 0, 0, 0, 1, 0]
    topic, info = "/camera/depth/image_rect_raw", camera_row(coefficients=(0.3, 0, 0, 0, 0), p=p)
    rows = [info, image_row(image, 0, topic=topic)]
    path = write_bag(tmp_path / "walk", "mcap", rows)
    (one,), _ = frames_of(path)
    assert one.frame.camera == Camera(176, 144, 240.0, 241.0, 88.0, 72.0)
    np.testing.assert_array_equal(one.frame.depth, image / 1000.0)
    (raw,), _ = frames_of(path, rectified=False)
    assert raw.frame.camera == CAMERA
    assert (raw.frame.depth != image / 1000.0).any()


def test_topics_are_chosen_by_their_camera_or_by_name(tmp_path, walk):
    other = "/other/depth/image_raw"
    images = [image_row(np.full((144, 176), 1234, "u2"), n, topic=other) for n in range(2)]
    path = write_bag(tmp_path / "one", "mcap", [*walk_rows(COUNT), *images])
    check_walk(frames_of(path)[0], walk)
    found, _ = frames_of(path, topic=other, camera_info=INFO)
    assert [one.frame.depth.max() for one in found] == [1.234, 1.234]
    both = [*walk_rows(1), *images, camera_row(topic="/other/depth/camera_info")]
    path = write_bag(tmp_path / "two", "mcap", both)
    error = refusal(path)
    assert isinstance(error, ConfigError)
    assert all(word in str(error) for word in (TOPIC, other, "'topic'", str(path)))
    assert len(frames_of(path, topic=other)[0]) == 2


def test_colour_images_are_no_depth_images(tmp_path, walk):
    colour = np.zeros((144, 176), "u2")
    rows = [
        *walk_rows(COUNT),
        image_row(colour, 0, topic="/camera/color/image_raw", encoding="mono8"),
        camera_row(topic="/camera/color/camera_info"),
    ]
    check_walk(frames_of(write_bag(tmp_path / "walk", "mcap", rows))[0], walk)


@pytest.mark.parametrize(
    ("rows", "fields", "words"),
    [
        ([image_row(walk_images(1)[0], 0)], {}, [TOPIC, INFO, "camera_info"]),
        ([camera_row()], {}, ["no depth image"]),
        ([camera_row(), image_row(walk_images(1)[0], 0, encoding="rgb8")],
         {"topic": TOPIC}, [TOPIC, "rgb8", "16UC1"]),
        (walk_rows(1), {"topic": "/camera/depth/image"}, ["'topic'", "did you mean", TOPIC]),
        (walk_rows(1), {"camera_info": "/info"}, ["'camera_info'", INFO]),
        ([camera_row(k=[0.0] * 9), image_row(walk_images(1)[0], 0)], {}, [INFO, "calibrated"]),
        ([camera_row(roi={"x_offset": 8}), image_row(walk_images(1)[0], 0)], {}, [INFO, "roi"]),
        ([camera_row(binning=2), image_row(walk_images(1)[0], 0)], {}, [INFO, "binned"]),
        ([camera_row(model="odd", coefficients=(0.1,)), image_row(walk_images(1)[0], 0)], {},
         [INFO, "odd", "plumb_bob"]),
        ([camera_row(), image_row(walk_images(1)[0][:100], 0)], {}, ["176x100", "176x144"]),
    ],
)  # fmt: skip
def test_bag_without_a_depth_image_and_its_camera_says_what_is_missing(
    tmp_path, rows, fields, words
):
    path = write_bag(tmp_path / "odd", "mcap", rows)
    told = str(refusal(path, **fields))
    assert str(path) in told
    assert all(word in told for word in words), told


def test_damaged_image_is_told_and_the_next_one_read(tmp_path):
    rows = walk_rows(3)
    topic, time, fields = rows[2]
    rows[2] = topic, time, {**fields, "data": fields["data"][:1000]}
    with Source.at(write_bag(tmp_path / "odd", "mcap", rows)).open() as stream:
        assert stream.read() is not None
        with pytest.raises(DataError, match=r"image 1: .*1000 bytes"):
            stream.read()
        assert stream.read() is not None
        assert stream.read() is None
        assert stream.read() is None


def test_time_that_goes_back_is_told(tmp_path):
    rows = walk_rows(3)
    topic, time, fields = rows[2]
    rows[2] = topic, time, {**fields, "stamp": time - 10**9}
    with Source.at(write_bag(tmp_path / "odd", "mcap", rows)).open() as stream:
        assert stream.read() is not None
        with pytest.raises(DataError, match="image 1: the frame's time"):
            stream.read()
        assert stream.read() is not None


@pytest.mark.parametrize("kind", ["mcap file", "bag", "db3 file"])
@pytest.mark.parametrize("share", [0.0, 0.01, 0.5, 0.9])
def test_bag_that_is_cut_short_is_told(tmp_path, kind, share):
    path = write_bag(tmp_path / "walk", kind, walk_rows(8))
    content = path.read_bytes()
    path.write_bytes(content[: int(share * len(content))])
    error = refusal(path)
    assert isinstance(error, DataError | SourceLostError)
    assert str(path) in str(error)


def test_folder_without_its_files_is_told(tmp_path):
    path = write_bag(tmp_path / "walk", "mcap", walk_rows(1))
    next(path.glob("*.mcap")).unlink()
    assert "walk.mcap" in str(refusal(path))


def test_missing_library_is_told_with_the_command_that_installs_it(tmp_path, monkeypatch):
    path = write_bag(tmp_path / "walk", "mcap", walk_rows(1))
    monkeypatch.setitem(sys.modules, "rosbags.highlevel", None)
    with pytest.raises(DependencyError, match=r"regkit\[ros\]"):
        Source.at(path).open()
