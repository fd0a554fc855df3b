"""Recordings of Azure Kinect, as far as its documents and code say how they are laid out."""

import numpy as np
import pytest
from kinect_files import PARAMETERS, calibration, kinect_bytes, write_kinect

from regkit.geometry import Camera, Lens
from regkit.geometry.distortion import BrownConrady
from regkit.interfaces import Source
from regkit.system.errors import DataError, RegkitError, SourceLostError
from regkit_plugins.sources.azure_kinect import AzureKinect

COUNT = 5

PUBLISHED = Camera(640, 576, 503.927643, 503.978729, 332.064270, 325.880615)
"""What the camera's own library says of the camera of ``PARAMETERS`` at 640x576."""


@pytest.fixture
def images(random):
    depth = random.integers(500, 5000, size=(COUNT, 576, 640)).astype(np.uint16)
    return depth * (random.uniform(size=depth.shape) < 0.8)


def frames_of(path):
    with Source.at(path).open() as stream:
        return list(stream)


@pytest.mark.parametrize("group", [False, True])
def test_images_are_read_and_rectified(tmp_path, images, group):
    path = write_kinect(tmp_path / "walk.mkv", images, group=group)
    source = Source.at(path)
    assert isinstance(source, AzureKinect)
    with source.open() as stream:
        assert (stream.name, stream.fps, stream.depth_scale) == ("walk", 30.0, 1000.0)
        found = list(stream)
        assert stream.read() is None
    assert len(found) == COUNT
    k1, k2, k3, k4, k5, k6 = PARAMETERS[4:10]
    p2, p1 = PARAMETERS[12:]
    camera = found[0].frame.camera
    lens = Lens(camera, BrownConrady((k1, k2, p1, p2, k3, k4, k5, k6)))
    for index, (one, image) in enumerate(zip(found, images, strict=True)):
        np.testing.assert_array_equal(one.frame.depth, lens.rectified(image / 1000.0))
        assert one.time == pytest.approx(1.0 + 0.033333 * index, abs=1e-9)


def test_camera_is_what_its_own_library_says(tmp_path, images):
    found = frames_of(write_kinect(tmp_path / "walk.mkv", images[:1]))[0].frame.camera
    for name in ("width", "height", "fx", "fy", "cx", "cy"):
        assert getattr(found, name) == pytest.approx(getattr(PUBLISHED, name), abs=1e-5)


@pytest.mark.parametrize(
    ("shape", "factor", "corner"),
    [((288, 320), 0.5, (96, 90)), ((512, 512), 0.5, (0, 0)), ((1024, 1024), 1.0, (0, 0))],
)
def test_camera_of_every_mode_sees_the_same_directions(tmp_path, shape, factor, corner):
    """Pixels are binned, and cut from the sensor at the same place."""
    image = np.full(shape, 1000, np.uint16)
    camera = frames_of(write_kinect(tmp_path / "walk.mkv", [image]))[0].frame.camera
    assert camera.fx == pytest.approx(factor * PUBLISHED.fx, abs=1e-4)
    on_sensor = (camera.cx + 0.5 + corner[0]) / factor
    assert on_sensor == pytest.approx(PUBLISHED.cx + 0.5 + 192, abs=1e-4)


@pytest.mark.parametrize(
    ("options", "word"),
    [
        ({"attached": {}}, "calibration.json"),
        ({"attached": {"CalibrationInformation": {}}}, "Cameras"),
        ({"attached": {"CalibrationInformation": {"Cameras": []}}}, "depth camera"),
        ({"attached": calibration(model="Rational6KT")}, "Rational6KT"),
        ({"attached": calibration(PARAMETERS[:10])}, "unpack"),
        ({"attached": calibration([*PARAMETERS[:10], 0.1, 0.0, 0.0, 0.0])}, "centre"),
        ({"name": "IR"}, "DEPTH"),
        ({"code": b"MJPG"}, "compressed"),
    ],
)
def test_recording_that_cannot_be_used_says_why(tmp_path, images, options, word):
    path = write_kinect(tmp_path / "walk.mkv", images[:1], **options)
    with pytest.raises(DataError) as caught:
        AzureKinect(path=path).open()
    assert str(caught.value).startswith(f"{path}: ")
    assert word in caught.value.message


def test_image_of_another_mode_is_told(tmp_path):
    path = write_kinect(tmp_path / "walk.mkv", [np.ones((100, 100), np.uint16)])
    with pytest.raises(DataError, match="100x100"):
        AzureKinect(path=path).open()


def test_other_films_are_not_accepted(tmp_path, images):
    content = kinect_bytes(images[:1]).replace(b"Azure Kinect", b"Other Camera")
    path = tmp_path / "film.mkv"
    path.write_bytes(content)
    with pytest.raises(DataError, match="none of azure_kinect"):
        Source.at(path)


def test_frames_before_the_end_of_a_file_that_is_cut_short_are_read(tmp_path, images):
    content = kinect_bytes(images)
    path = tmp_path / "walk.mkv"
    size = images[0].nbytes
    for lost in range(1, COUNT):
        path.write_bytes(content[: len(content) - lost * size])
        found = []
        with Source.at(path).open() as stream:
            with pytest.raises(SourceLostError, match=rf"image {COUNT - lost}: .*cut short"):
                found.extend(stream)
            assert stream.read() is None
        assert len(found) == COUNT - lost


@pytest.mark.parametrize("length", [0, 1, 30, 200, 700])
def test_header_that_is_cut_short_is_told(tmp_path, images, length):
    path = tmp_path / "walk.mkv"
    path.write_bytes(kinect_bytes(images[:1])[:length])
    with pytest.raises(RegkitError, match=r"walk\.mkv"):
        AzureKinect(path=path).open()


def test_damaged_image_is_told_and_the_next_one_read(tmp_path, images):
    path = write_kinect(tmp_path / "walk.mkv", [images[0], images[1][:100], images[2]])
    with Source.at(path).open() as stream:
        assert stream.read() is not None
        with pytest.raises(DataError, match="image 1"):
            stream.read()
        assert stream.read() is not None
        assert stream.read() is None
