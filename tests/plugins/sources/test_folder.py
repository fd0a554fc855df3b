"""Folders as sources: the frames are those of the datasets."""

import numpy as np
import pytest
from places import DATA

from regkit.interfaces import Dataset, Source
from regkit.system.errors import DataError
from regkit_plugins.sources.folder import Folder


@pytest.mark.parametrize("name", ["human_walk", "hand_gestures", "mannequin"])
def test_frames_of_a_folder_are_those_of_its_dataset(name):
    data = Dataset.in_folder(DATA / name)
    recording = Dataset.parse(data, place="here", field="dataset").only()
    with Source.at(DATA / name).open() as stream:
        found = list(stream)
    assert (stream.name, stream.fps) == (recording.name, recording.fps)
    assert len(found) == stream.length == recording.length
    for index, (one, frame) in enumerate(zip(found, recording.frames(), strict=True)):
        np.testing.assert_array_equal(one.frame.points, frame.points)
        assert one.frame.camera == frame.camera
        if frame.depth is not None:
            np.testing.assert_array_equal(one.frame.depth, frame.depth)
        assert one.time == index / recording.fps


def test_folder_that_is_no_recording_is_told(tmp_path):
    for path in (tmp_path, tmp_path / "missing", DATA / "human_walk" / "camera.json"):
        with pytest.raises(DataError) as caught:
            Folder(path=path).open()
        assert str(caught.value).startswith(f"{path}: ")
