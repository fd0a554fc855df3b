"""RealSense cameras and recordings, by the software device of RealSense's own library."""

import sys
from itertools import count
from pathlib import Path

import numpy as np
import pytest
from bags import CAMERA, walk_images
from places import ASSETS

from regkit.geometry import Camera
from regkit.interfaces import Source
from regkit.system.errors import (
    ConfigError,
    DataError,
    DependencyError,
    RegkitError,
    SourceLostError,
)
from regkit_plugins.sources.realsense import RealSense, RealSenseRecording
from regkit_plugins.sources.realsense.devices import connected
from regkit_plugins.sources.realsense.stream import CameraStream

rs = pytest.importorskip("pyrealsense2")
soft_camera = pytest.importorskip("soft_camera")
SoftCamera, record_walk = soft_camera.SoftCamera, soft_camera.record_walk

COUNT = 6


@pytest.fixture(scope="module")
def recording(tmp_path_factory) -> Path:
    """The first frames of the shipped walk, recorded by RealSense's library."""
    return record_walk(tmp_path_factory.mktemp("realsense") / "walk.db3", COUNT)


def test_camera_shows_what_it_measures():
    camera, images = SoftCamera(), walk_images(3)
    with CameraStream(camera.device) as stream:
        assert (stream.name, stream.fps, stream.depth_scale) == ("Soft Camera 0123", 30.0, 1000.0)
        assert stream.live
        assert stream.length is None
        for number, image in enumerate(images):
            camera.show(image, number)
            timed = stream.read()
            np.testing.assert_array_equal(timed.frame.depth, image / 1000.0)
            assert timed.frame.camera == CAMERA
            assert timed.time == pytest.approx(number / 30.0)
        assert stream.dropped == 0
    assert stream.read() is None
    stream.close()


def test_frames_that_are_missed_are_counted():
    camera, (image,) = SoftCamera(), walk_images(1)
    with CameraStream(camera.device) as stream:
        for number in (0, 3, 4, 9):
            camera.show(image, number)
            stream.read()
        assert stream.dropped == 6


def test_camera_that_falls_silent_is_lost():
    camera, (image,) = SoftCamera(), walk_images(1)
    with CameraStream(camera.device, patience=0.1) as stream:
        camera.show(image, 0)
        assert stream.read() is not None
        with pytest.raises(SourceLostError, match="Soft Camera 0123: no frame"):
            stream.read()


@pytest.mark.parametrize(
    ("unit", "scale"), [(0.001, 1000.0), (0.0001, 10000.0), (0.0003, 1.0 / np.float32(0.0003))]
)
def test_units_of_depth_are_whole_where_single_precision_hides_it(unit, scale):
    camera, (image,) = SoftCamera(unit=unit), walk_images(1)
    with CameraStream(camera.device) as stream:
        camera.show(image, 0)
        assert stream.depth_scale == pytest.approx(scale, rel=1e-12)
        np.testing.assert_array_equal(stream.read().frame.depth, image / stream.depth_scale)


def test_distortion_is_taken_out_or_refused():
    some = (0.5, -0.2, 1e-2, 2e-2, 0.05)
    camera, (image,) = SoftCamera(coefficients=some), walk_images(1)
    with CameraStream(camera.device) as stream:
        camera.show(image, 0)
        assert (stream.read().frame.depth != image / 1000.0).any()
    inverse = rs.distortion.inverse_brown_conrady
    CameraStream(SoftCamera(model=inverse).device).close()
    with pytest.raises(DataError, match="inverse_brown_conrady"):
        CameraStream(SoftCamera(model=inverse, coefficients=some).device)


def test_size_and_rate_are_chosen_among_the_cameras_own():
    assert CameraStream(SoftCamera().device, fps=15).fps == 15.0
    assert CameraStream(SoftCamera().device, width=176).fps == 30.0
    with pytest.raises(DataError, match="176x144 at 15, 176x144 at 30"):
        CameraStream(SoftCamera().device, width=640)


class Context:
    """What the library's context knows: cameras."""

    def __init__(self, *serials):
        self.cameras = [SoftCamera(serial) for serial in serials]

    def query_devices(self):
        return [camera.device for camera in self.cameras]


def test_camera_is_the_only_one_or_named_by_its_serial_number():
    number = rs.camera_info.serial_number
    assert connected(Context("1"), "").get_info(number) == "1"
    assert connected(Context("1", "2"), "2").get_info(number) == "2"
    with pytest.raises(ConfigError, match="1, 2; name one, as realsense:1"):
        connected(Context("1", "2"), "")
    with pytest.raises(DataError, match=r"realsense:3: .*there are: 1, 2"):
        connected(Context("1", "2"), "3")
    with pytest.raises(DataError, match="realsense: no RealSense"):
        connected(Context(), "")


@pytest.mark.parametrize(("address", "serial"), [("realsense:", ""), ("RealSense:0123", "0123")])
def test_address_of_a_camera_holds_its_serial_number(address, serial):
    source = Source.at(address, width=640)
    assert source == RealSense(serial=serial, width=640)


def test_recording_is_what_was_recorded(recording):
    source = Source.at(recording)
    assert isinstance(source, RealSenseRecording)
    for _ in range(2):
        with source.open() as stream:
            assert (stream.name, stream.fps, stream.depth_scale) == ("walk", 30.0, 1000.0)
            found = list(stream)
            assert stream.read() is None
        assert len(found) == COUNT
        for number, timed, image in zip(count(), found, walk_images(COUNT), strict=False):
            np.testing.assert_array_equal(timed.frame.depth, image / 1000.0)
            assert timed.frame.camera == Camera(176, 144, 231.0, 231.0, 87.5, 71.5)
            assert timed.time == pytest.approx(number / 30.0)


def test_bag_of_the_library_before_its_databases_is_read():
    """Written by version 2.55 of RealSense's library; later ones write databases."""
    source = Source.at(ASSETS / "realsense.bag")
    assert isinstance(source, RealSenseRecording)
    with source.open() as stream:
        found = list(stream)
    assert [one.frame.depth.max() for one in found] == [1.0, 1.001, 1.002, 1.003, 1.004]
    assert all((one.frame.depth == one.frame.depth.max()).all() for one in found)
    assert found[-1].time == pytest.approx(4 / 30.0)


@pytest.mark.parametrize("share", [0.0, 0.5])
def test_bag_that_is_cut_short_is_told(tmp_path, share):
    path = tmp_path / "cut.bag"
    content = (ASSETS / "realsense.bag").read_bytes()
    path.write_bytes(content[: int(share * len(content))])
    with pytest.raises(RegkitError, match=r"cut\.bag"), RealSenseRecording(path=path).open() as one:
        list(one)


@pytest.mark.parametrize("share", [0.0, 0.5])
def test_recording_that_is_cut_short_is_told(recording, tmp_path, share):
    path = tmp_path / "cut.db3"
    content = recording.read_bytes()
    path.write_bytes(content[: int(share * len(content))])
    with pytest.raises(RegkitError, match=r"cut\.db3"), RealSenseRecording(path=path).open() as one:
        list(one)


def test_missing_library_is_told_with_the_command_that_installs_it(recording, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyrealsense2", None)
    for source in (RealSense(), RealSenseRecording(path=recording)):
        with pytest.raises(DependencyError, match=r"regkit\[realsense\]"):
            source.open()
