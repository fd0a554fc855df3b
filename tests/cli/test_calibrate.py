"""``regkit calibrate``: a template of the person seen, and what it refuses."""

import numpy as np
import pytest
from messages import tells
from places import EXAMPLES
from small_experiment import QUICK

from regkit.body import BodyDescription
from regkit.config.document import Document

HUMAN = ("--template", "{kind: human, height: 1.63}")


@pytest.fixture
def subject(tmp_path):
    return tmp_path / "subject.yaml"


def test_calibrate_writes_a_template_that_experiments_can_use(regkit, files, subject):
    recording = files.data / "first"
    ended = regkit("calibrate", recording, *HUMAN, "--out", subject)
    assert ended.code == 0, ended.err
    assert ended.err == ""
    assert "weight" in ended.out
    assert f"written: {subject}" in ended.out
    assert regkit("validate", subject).code == 0
    description = Document.read(subject).validated(BodyDescription)
    assert 1.5 < description.size.value < 1.75
    assert "2 frames of the recording first" in description.sources[-1]
    left, right = (description.segments[f"{side}_shin"].offset for side in ("left", "right"))
    assert left[1:] == pytest.approx(right[1:], abs=1e-3)
    # The skin has the same proportions.
    body = description.body("subject", description.size.value)
    transforms = body.place(body.skeleton.rest()).transforms
    gaps = body.capsules.place(transforms).surface_distance(body.surface.place(transforms))
    assert np.median(np.abs(gaps)) < 0.012
    # A few exemplars suffice for one frame, and are quick to make.
    changes = (
        f"template={{kind: file, path: {subject}}}",
        "start={kind: exemplars, exemplars: 500}",
    )
    options = [word for change in changes for word in ("--set", change)]
    ended = regkit("run", files.experiment, "--out", files.out, *options, *QUICK)
    assert ended.code == 0, ended.err


@pytest.mark.long
def test_a_calibrated_template_is_calibrated_further(regkit, files, subject):
    recording = files.data / "first"
    assert regkit("calibrate", recording, *HUMAN, "--out", subject).code == 0
    again = regkit("calibrate", recording, "--template", subject, "--out", subject)
    assert again.code == 0, again.err


@pytest.mark.long
def test_hand_of_the_sample_is_calibrated_in_its_noise(regkit, subject):
    ended = regkit(
        "calibrate", EXAMPLES / "data" / "hand_gestures", "--template", "hand", "--frames", "4",
        "--out", subject,
    )  # fmt: skip
    assert ended.code == 0, ended.err
    size = Document.read(subject).validated(BodyDescription).size.value
    assert size == pytest.approx(0.1858, rel=0.02)


def test_calibrate_takes_an_experiments_data_template_and_start(regkit, files, subject):
    ended = regkit("calibrate", files.experiment, "--recording", "second", "--out", subject)
    assert ended.code == 0, ended.err
    assert "recording second" in subject.read_text()


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        (("--template", "humn"), "no plug-in 'humn' in regkit.templates"),
        (("--template", "{kind: human, hight: 2}"), "template.hight: no such field"),
        (("--template", "none.yaml"), "none.yaml: there is no such file"),
        (("--template", "{kind"), "not valid YAML"),
        (("--recording", "frist"), "--recording: no recording 'frist'"),
        ((), "--recording: there are 2 recordings (first, second); name one"),
        (("--set", "dataset.frames=1"), "--set changes the values of an experiment"),
    ],
)
def test_calibrate_refuses_what_it_cannot_use(regkit, files, subject, options, complaint):
    ended = regkit("calibrate", files.data, *options, "--out", subject)
    assert ended.code == 1
    assert complaint in ended.err
    assert not subject.exists()


def test_calibrate_refuses_what_is_no_folder(regkit, tmp_path, subject):
    ended = regkit("calibrate", tmp_path / "nothing", "--out", subject)
    assert ended.code == 1
    assert tells(ended.err, at=f"{tmp_path / 'nothing'}", of="no such file")
    ended = regkit("calibrate", tmp_path, "--out", subject)
    assert ended.code == 1
    assert "no recording here" in ended.err


def test_calibrate_overwrites_templates_only(regkit, files):
    before = files.experiment.read_text()
    ended = regkit("calibrate", files.data / "first", "--out", files.experiment)
    assert ended.code == 1
    assert "--out" in ended.err
    assert "is not a template" in ended.err
    assert files.experiment.read_text() == before


def test_calibrate_wants_a_surface(regkit, files, tmp_path, subject):
    bare = tmp_path / "bare.yaml"
    bare.write_text(
        "title: bones\nsize: {name: height, value: 1, range: [0.5, 2]}\n"
        "segments: {base: {joint: {type: free}}}\n"
    )
    ended = regkit("calibrate", files.data / "first", "--template", bare, "--out", subject)
    assert ended.code == 1
    assert "has no capsules" in ended.err


@pytest.mark.long
def test_calibrate_tells_lengths_and_girths_of_a_template_without_modes(regkit, files, subject):
    small = "{kind: human, build: small, height: 1.63}"
    recording = files.data / "first"
    ended = regkit("calibrate", recording, "--template", small, "--out", subject)
    assert ended.code == 0, ended.err
    assert "forearm" in ended.out
    assert "girth" in ended.out
