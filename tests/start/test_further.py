"""A hand's start has a forearm if the data show one, and everything after it knows."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from lamp import CAMERA, seen
from scenes import frame_of

from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.interfaces import Template
from regkit.observation import TimedFrame
from regkit.recording import FolderWriter
from regkit.skeleton import Pose
from regkit.start import with_further_parts
from regkit_plugins.starts.exemplars import Exemplars
from regkit_plugins.starts.stances import Stances
from regkit_plugins.templates.composed import Composed
from regkit_plugins.templates.hand import Hand

SIZE = 0.19
SEARCH = Exemplars(exemplars=2000)
START = "{kind: exemplars, exemplars: 2000}"
EXPERIMENT = f"""
name: hand
dataset: {{kind: depth, root: data}}
template: {{kind: hand, length: {SIZE}}}
preprocessor: {{kind: points, voxel: 0.01, sigma: 0.005}}
start: {START}
methods: {{best: {{preset: best}}}}
"""


def before_camera(body) -> Pose:
    """The hand upright before the camera, the palm or the back turned aside."""
    rest = body.skeleton.rest()
    turned = np.diag([1.0, -1.0, -1.0]) @ vector_to_matrix(np.array([0.0, 0.5, 0.2]))
    return Pose(rigid(turned, np.array([0.0, 0.05, 0.7])), rest.balls, rest.hinges)


def shown(*, forearm: bool):
    """What a camera shows of a hand, and where its markers are."""
    body = Hand(length=SIZE, forearm=forearm).body(SIZE)
    pose = before_camera(body)
    return seen(body, pose, image=True), body.markers.place(body.place(pose).transforms)


@pytest.mark.parametrize("forearm", [False, True])
def test_the_data_decide_whether_a_hand_has_a_forearm(forearm):
    observation, markers = shown(forearm=forearm)
    start = SEARCH.find(Hand(length=SIZE), [observation])
    assert start.extended == forearm
    assert ("forearm" in start.body.skeleton.names) == forearm
    found = start.body.markers.place(start.body.place(start.pose).transforms)
    assert np.linalg.norm(found - markers, axis=1).mean() < 0.01


def test_every_search_lets_the_data_decide():
    start = Stances().find(Hand(length=SIZE), [shown(forearm=True)[0]])
    assert start.extended
    assert "forearm" in start.body.skeleton.names


@pytest.mark.parametrize("given", [False, True])
def test_a_configuration_that_says_so_decides(given):
    hand = Hand(length=SIZE, forearm=given)
    assert hand.extended() is None
    assert hand.plain().forearm == hand.chosen(extended=True).forearm == given
    names = hand.chosen(extended=True).body(SIZE).skeleton.names
    assert ("forearm" in names) == given
    assert with_further_parts(SEARCH.find, hand, [shown(forearm=True)[0]]) is None


def test_a_part_of_another_body_has_no_forearm():
    both: Template = Composed(free={"left": Hand(side="left"), "right": Hand()})
    names = both.body(SIZE).skeleton.names
    assert not any(name.endswith("forearm") for name in names)
    assert all(one.extended() is None for one in both.free_bodies().values())


def write(folder: Path, *, forearm: bool) -> None:
    with FolderWriter(folder, "hand", 30.0, 10000.0) as writer:
        for index in range(2):
            depth = shown(forearm=forearm)[0].depth
            writer.add(TimedFrame(frame_of(np.nan_to_num(depth), CAMERA), index / 30.0))


def segments(regkit, track: Path, out: Path) -> set[str]:
    ended = regkit("export", track, "--to", out)
    assert ended.code == 0, ended.err
    with out.open(newline="") as stream:
        return {row["name"] for row in csv.DictReader(stream) if row["kind"] == "segment"}


@pytest.mark.parametrize("forearm", [False, True])
def test_a_track_and_its_export_have_the_segments_of_the_start(regkit, tmp_path, forearm):
    write(tmp_path / "data", forearm=forearm)
    options = ("--template", f"{{kind: hand, length: {SIZE}}}", "--set", f"start={START}")
    ended = regkit("track", tmp_path / "data", *options, "--out", tmp_path / "track")
    assert ended.code == 0, ended.err
    assert ("forearm" in segments(regkit, tmp_path / "track", tmp_path / "track.csv")) == forearm


def test_a_run_that_is_continued_keeps_what_its_start_has_chosen(regkit, tmp_path):
    write(tmp_path / "data", forearm=True)
    experiment, out = tmp_path / "hand.yaml", tmp_path / "out"
    experiment.write_text(EXPERIMENT)
    assert regkit("run", experiment, "--out", out, "--no-figures").code == 0
    (start,) = (out / "starts").glob("*.json")
    found, poses = start.read_bytes(), out / "best" / "hand" / "poses.npz"
    with np.load(poses) as arrays:
        first = dict(arrays)
    poses.unlink()
    assert regkit("run", experiment, "--out", out, "--no-figures").code == 0
    assert start.read_bytes() == found
    with np.load(poses) as again:
        np.testing.assert_array_equal(again["root"], first["root"])
    assert "forearm" in segments(regkit, poses.parent, tmp_path / "run.csv")
