"""The default segmentation leaves a body alone as it is, and takes it out of a room."""

import numpy as np
import pytest
from places import DATA
from scenes import recording, write_recording

import regkit
from regkit.config.document import Document
from regkit.experiment import Experiment
from regkit.geometry.rotation import vector_to_matrix
from regkit.interfaces import Chain, Segmenter, each_body
from regkit.observation import Frame
from regkit.skeleton import Placement
from regkit.system.errors import NoDataError
from regkit.testing.scenes import WALL, SceneTemplate, WallScene
from regkit.tracking.given_frames import GivenFrames
from regkit_plugins.segmenters.room import Room
from regkit_plugins.templates.human import Human

TEMPLATE = SceneTemplate()
WALLED = WallScene("scene", 30.0, 4)


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


def test_each_body_has_its_own_segmentation():
    """Two bodies beside each other before a wall; a board is none."""
    one, two = WALLED.shots[0].depth, np.roll(WALLED.shots[0].depth, 70, axis=1) + 0.3
    depth = np.minimum(one, np.minimum(two, WALL))
    depth[125:143, 100:170] = 2.5
    frames = recording(depth)
    (frame,) = frames.frames()
    each = each_body((Room(),), frames, TEMPLATE)
    assert len(each) == 2
    with pytest.warns(regkit.RegkitWarning, match="took the body out"):
        lefts = [Chain.of(one, frames, TEMPLATE).segmented(frame, None) for one in each]
    for left, shown in zip(lefts, (one < WALL, two < WALL), strict=True):
        seen = left.depth > 0.0
        assert not (seen & ~shown).any()
        assert seen[shown].mean() > 0.99
    gate = Segmenter.parse("gate", place="a test", field="segmentation")
    assert each_body((gate,), frames, TEMPLATE) == ((gate,),)


def test_room_leaves_a_scan_from_all_sides_alone():
    human = Human()
    surface = human.body(1.9).surface
    bones = human.body(1.9).skeleton
    corners = surface.place(Placement.of(bones, bones.rest()).transforms)[surface.faces]
    random = np.random.default_rng(0)
    chosen = corners[random.integers(len(corners), size=20000)]
    points = np.einsum("nc,nci->ni", random.dirichlet(np.ones(3), len(chosen)), chosen)
    turn = vector_to_matrix(np.array([1.0, 0.6, -0.4]))
    frame = Frame(points @ turn.T + [0.3, -0.2, 2.5])
    recording = GivenFrames(name="scan", fps=1.0, length=1, given=(frame,))
    bound = Room().bind(recording, human)
    assert len(bound.segmented(frame, None).points) == len(points)
