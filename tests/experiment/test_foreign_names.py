"""Names and links that others chose, in a run and its results."""

from __future__ import annotations

import csv
import shutil

import pytest
from small_experiment import copy_recording, small

from regkit.experiment import Experiment, found, run
from regkit.experiment.tracked_motion import read_tracked_motion
from regkit.interfaces import Dataset
from regkit.system.errors import ConfigError, DataError
from regkit.system.notes import RegkitWarning

FOREIGN = "=1+1\x1b[2J\n\u202e"
CLEAN = "_=1+1_[2J__"


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    """A small experiment whose only recording has a name that no one would choose."""
    files = small(tmp_path_factory.mktemp("foreign"))
    shutil.rmtree(files.data)
    copy_recording(files.data / FOREIGN)
    (files.data / FOREIGN / "sequence.yaml").write_text("fps: 30\n")
    return files


@pytest.mark.filterwarnings("ignore:the recording")
def test_recording_has_a_clean_name_everywhere_and_links_out_of_results_are_refused(done):
    experiment = Experiment.read(done.experiment, ["dataset.frames=1"])
    outcome = run(experiment, done.out, figures=False)
    assert list(outcome.measures["gsog"]) == [CLEAN]
    assert sorted(path.name for path in (done.out / "gsog").iterdir()) == [CLEAN]
    with (done.out / "tables" / "recordings.csv").open(newline="") as stream:
        assert [row["recording"] for row in csv.DictReader(stream)] == [CLEAN]
    found(done.out)

    outside = done.out.parent / "outside"
    shutil.move(done.out / "gsog" / CLEAN, outside)
    link = done.out / "gsog" / CLEAN
    link.symlink_to(outside)
    for read in (
        lambda: found(done.out),
        lambda: read_tracked_motion(link),
        lambda: run(experiment, done.out, figures=False),
    ):
        with pytest.raises(DataError, match="symbolic link") as caught:
            read()
        assert caught.value.place == str(link)


def test_recording_is_chosen_by_both_names(tmp_path):
    copy_recording(tmp_path / "a.")
    (tmp_path / "a." / "sequence.yaml").write_text("fps: 30\n")
    dataset = Dataset.parse(Dataset.at(tmp_path), place="here", field="dataset")
    for name in ("a.", "a._"):
        with pytest.warns(RegkitWarning):
            assert dataset.only(name).name == "a._"


@pytest.mark.parametrize("name", ["con", "NUL.x", "x" * 200, "walk.", "a\nb"])
def test_name_that_is_no_folder_everywhere_is_refused(files, name):
    with pytest.raises(ConfigError, match="folder"):
        Experiment.read(files.experiment, [f"name={name!r}".replace("'", '"')])
