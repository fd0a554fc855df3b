"""The default segmentation leaves a body alone as it is, and takes it out of a room."""

import numpy as np
import pytest
from places import DATA
from scenes import recording, write_recording

import regkit
from regkit.config.document import Document
from regkit.experiment import Experiment
from regkit.interfaces import Segmenter
from regkit.system.errors import NoDataError
from regkit.testing.scenes import SIZE, SceneTemplate, WallScene
from regkit_plugins.segmenters.room import Room

TEMPLATE = SceneTemplate()
WALLED = WallScene("scene", 30.0, 4)
START = {"root": {"position": [-0.4, 0.1, 2.0], "rotation_deg": [180, 0, 0]}}


def test_room_is_the_default():
    assert Segmenter.default() == {"kind": "room"}


@pytest.mark.parametrize(
    ("name", "template"),
    [("human_walk", "human"), ("hand_gestures", "hand"), ("mannequin", "mannequin/model.npz")],
)
def test_body_alone_stays_as_it_is(name, template):
    frames = regkit.load_recording(DATA / name, frames=3)
    given = str(DATA / template) if "/" in template else template
    bound = Room().bind(frames, regkit.load_template(given))
    for frame in frames.frames():
        assert bound.segmented(frame, None) is frame


def test_body_before_a_wall_is_taken_out_and_told():
    with pytest.warns(regkit.RegkitWarning, match=r"removed 1 plane and kept piece 0 of 1"):
        bound = Room().bind(WALLED, TEMPLATE)
    for index, frame in enumerate(WALLED.frames()):
        seen = bound.segmented(frame, None).depth > 0.0
        np.testing.assert_array_equal(seen, WALLED.shown(index))


@pytest.fixture(scope="module")
def template_file(tmp_path_factory):
    from regkit.testing.samples import LINKAGE

    text = LINKAGE.read_text().replace("value: 1.0, range: [0.5, 2.0]", f"value: {SIZE}")
    file = tmp_path_factory.mktemp("template") / "linkage.yaml"
    file.write_text(text.replace(f"value: {SIZE}", f"value: {SIZE}, range: [{SIZE}, {SIZE}]"))
    return file


def test_track_in_a_room_is_that_of_the_body_alone():
    alone = [np.where(WALLED.shown(index), frame.depth, 0.0)
             for index, frame in enumerate(WALLED.frames())]  # fmt: skip
    with pytest.warns(regkit.RegkitWarning, match="took the body out"):
        room = regkit.track(WALLED, TEMPLATE, start=WALLED.pose(0))
    single = regkit.track(recording(*alone), TEMPLATE, start=WALLED.pose(0))
    np.testing.assert_allclose(room.markers, single.markers, atol=1e-9)
    # A picture of a frame that was not kept shows what was tracked.
    np.testing.assert_array_equal(room.snapshot(1).points, single.snapshot(1).points)


def test_frame_without_the_body_has_no_data_and_says_why():
    wall = np.full((144, 176), 3.0)
    with (
        pytest.warns(regkit.RegkitWarning, match="found no piece"),
        pytest.raises(NoDataError, match=r"may be the body's \(segmentation"),
    ):
        regkit.track(recording(wall, wall), TEMPLATE, start=WALLED.pose(0), preprocessor="points")


def test_segmentation_is_a_part_of_an_experiment_and_may_be_empty():
    data = {
        "name": "one", "dataset": {"kind": "depth", "root": "."}, "template": "human",
        "methods": {"best": {"preset": "best"}},
    }  # fmt: skip
    document = Document(data, {(): "a test"})
    assert [one.kind for one in document.validated(Experiment).segmentation] == ["room"]
    for given, kinds in ([], []), (["planes", {"kind": "gate"}], ["planes", "gate"]):
        document = Document({**data, "segmentation": given}, {(): "a test"})
        assert [one.kind for one in document.validated(Experiment).segmentation] == kinds


def test_preview_shows_what_each_step_removes(regkit, tmp_path):
    folder = write_recording(tmp_path / "walled", [frame.depth for frame in WALLED.frames()])
    out, told = tmp_path / "shown.png", "{kind: hand, length: 0.2}"
    ended = regkit(
        "preview", folder, "--template", told, "--segmentation", "planes,gate", "--frames", 2,
        "--out", out,
    )  # fmt: skip
    assert ended.code == 0, ended.err
    assert out.stat().st_size > 1000
    count = WALLED.shown(0).sum()
    assert f"│ {count}" in ended.out
    assert "planes removes" in ended.out
    ended = regkit("preview", folder, "--template", told, "--segmentation", "[]", "--out", "a.txt")
    assert ended.code == 1
    assert "--out: 'a.txt' must end with .png" in ended.err
    ended = regkit("preview", folder, "--segmentation", "plane", "--out", out)
    assert ended.code == 1
    assert "did you mean 'planes'?" in ended.err
    nothing = write_recording(tmp_path / "nothing", [np.full((144, 176), 3.0)])
    ended = regkit("preview", nothing, "--template", told, "--segmentation", "planes", "--out", out)
    assert ended.code == 3
    assert "no point is left" in ended.err
