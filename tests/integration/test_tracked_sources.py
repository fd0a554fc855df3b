"""The shipped walk from every kind of source is tracked alike, to the last bit."""

from pathlib import Path

import numpy as np
import pytest
from bags import walk_images, walk_rows, write_bag
from places import DATA

from regkit import RegkitError, load_recording, track
from regkit.api.live import live_track
from regkit.api.pipeline import Pipeline
from regkit.interfaces import Dataset

WALK = DATA / "human_walk"
COUNT = 5
HUMAN = {"kind": "human", "height": 1.63}
TEMPLATE = ("--template", "{kind: human, height: 1.63}")


@pytest.fixture(scope="module")
def markers() -> np.ndarray:
    """The markers of the folder's first frames."""
    return track(load_recording(WALK, frames=COUNT), HUMAN).markers


@pytest.fixture(scope="module")
def bag(tmp_path_factory) -> Path:
    return write_bag(tmp_path_factory.mktemp("bag") / "walk", "mcap file", walk_rows(COUNT))


def tracked(regkit, source: Path, out: Path, *more: str) -> np.ndarray:
    ended = regkit("track", source, *TEMPLATE, "--frames", COUNT, "--out", out, *more)
    assert ended.code == 0, ended.err
    with np.load(out / "poses.npz") as arrays:
        return arrays["markers"]


def test_folder_is_tracked_as_its_dataset(regkit, tmp_path, markers):
    np.testing.assert_array_equal(tracked(regkit, WALK, tmp_path / "out"), markers)


@pytest.mark.parametrize("kind", ["mcap", "db3 file", "bag"])
def test_bag_is_tracked_as_its_folder(regkit, tmp_path, markers, kind):
    source = write_bag(tmp_path / "walk", kind, walk_rows(COUNT))
    np.testing.assert_array_equal(tracked(regkit, source, tmp_path / "out"), markers)


def test_realsense_recording_is_tracked_as_its_folder(regkit, tmp_path, markers):
    pytest.importorskip("pyrealsense2")
    from soft_camera import record_walk

    source = record_walk(tmp_path / "walk.db3", COUNT)
    np.testing.assert_array_equal(tracked(regkit, source, tmp_path / "out"), markers)


def test_camera_is_tracked_as_its_folder(markers):
    pytest.importorskip("pyrealsense2")
    from soft_camera import SoftCamera

    from regkit_plugins.sources.realsense.stream import CameraStream

    class Fed(CameraStream):
        """A camera that measures a frame when the last one was read, and is then switched off."""

        def read(self):
            image = next(images, None)
            if image is None:
                return None
            camera.show(image, COUNT - 1 - images.__length_hint__())
            return super().read()

    camera, images = SoftCamera(), iter(walk_images(COUNT))
    pipeline = Pipeline.of(HUMAN, place="test")
    with live_track(lambda: Fed(camera.device), pipeline, every_frame=True) as live:
        found = [pose.markers for pose in live]
    np.testing.assert_array_equal(found, markers)


def test_file_is_a_recording_of_every_command(regkit, bag, tmp_path):
    recording = load_recording(bag)
    assert (recording.length, recording.fps) == (COUNT, pytest.approx(30.0, rel=1e-3))
    ended = regkit("preview", bag, *TEMPLATE, "--frames", 2, "--out", tmp_path / "shown.png")
    assert ended.code == 0, ended.err
    dataset = Dataset.parse(Dataset.at(bag), place="here", field="dataset")
    (found,) = dataset.chosen()
    np.testing.assert_array_equal(
        [frame.depth for frame in found.frames()], np.array(walk_images(COUNT)) / 1000.0
    )
    assert [index for index, _ in found.some([3, 1])] == [1, 3]


def test_camera_is_no_recording(monkeypatch, bag):
    dataset = Dataset.parse(Dataset.at(bag), place="here", field="dataset")
    with dataset.source.open() as stream:
        kind = type(stream)
    monkeypatch.setattr(kind, "live", True)
    with pytest.raises(RegkitError, match="cannot be read again"):
        dataset.found()
