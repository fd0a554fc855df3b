"""Replays: self-contained pages of limited size, also in notebooks."""

import base64
import gzip
import json
import re
import webbrowser
from dataclasses import replace

import numpy as np
import pytest
from made_tracks import made_scene

import regkit
from regkit.system.errors import ConfigError, DataError
from regkit.viewer.alignment_scene import alignment_scene
from regkit.viewer.embedded import SceneView
from regkit.viewer.recording_scene import recording_scene
from regkit.viewer.replay import BYTES, MOST_DOTS, replay
from regkit.viewer.run_scene import run_scene
from regkit.viewer.scene import Scene
from regkit.viewer.shapes import MeshShape
from regkit_plugins.shapes.gsog import GeneralizedSumOfGaussians
from regkit_plugins.templates.human import Human

BODY = Human(height=1.7).body(1.7)
GAUSSIANS = GeneralizedSumOfGaussians().bind(BODY)


def embedded(page: str) -> dict:
    data = re.search(r'<script id="scene"[^>]*>(.*?)</script>', page, re.DOTALL)
    return json.loads(gzip.decompress(base64.b64decode(data[1])))


def test_small_scene_is_embedded_as_it_is():
    scene = run_scene(
        "a walk", {"walk": {"m": lambda: made_scene(BODY, GAUSSIANS, 9)}}, {"m": "#000"}
    )
    assert embedded(replay(scene)) == json.loads(scene.json())


@pytest.mark.long
def test_long_track_with_many_points_is_thinned_to_five_megabytes():
    track = made_scene(BODY, GAUSSIANS, 5000, points=30_000)
    scene = run_scene("long", {"walk": {"m": lambda: track}}, {"m": "#000000"})
    assert scene.note == "60 of 5000 frames are shown."
    page = replay(scene)
    assert 0.6 * BYTES < len(page.encode()) <= BYTES
    (recording,) = embedded(page)["recordings"]
    assert len(recording["frames"]) == 60
    assert recording["length"] == 5000
    assert [one["frame"] for one in recording["marked"]] == [4999]
    note = embedded(page)["note"]
    share = float(re.search(r"(\d+) % of the points", note)[1]) / 100.0
    shown = recording["points"]["positions"]["shape"][0]
    assert shown == pytest.approx(share * 60 * 30_000, rel=0.2)


def test_meshes_become_points_where_there_is_no_room_for_them(random):
    count = 150_000
    mesh = MeshShape(
        vertices=random.normal(size=(count, 3)),
        triangles=random.integers(count, size=(count, 3)),
        carriers=np.zeros((count, 1), dtype=int),
        weights=np.ones((count, 1)),
        rest=np.tile([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], (15, 1)),
    )
    track = replace(made_scene(BODY, GAUSSIANS, 3), shapes=(mesh,))
    scene = Scene("t", (recording_scene("walk", {"m": track}, {"m": "#000000"}, 3),))
    page = replay(scene)
    assert len(page.encode()) < BYTES
    (method,) = embedded(page)["recordings"][0]["methods"]
    assert [one["kind"] for one in method["shapes"]] == ["points"]
    assert method["shapes"][0]["segments"]["shape"][0] <= MOST_DOTS
    assert "points" in embedded(page)["note"]


def test_scene_that_cannot_be_made_small_is_refused(random, monkeypatch):
    monkeypatch.setattr("regkit.viewer.replay.BYTES", 1_300_000)
    scene = alignment_scene("t", *(random.normal(size=(20_000, 3)) for _ in range(3)))
    with pytest.raises(DataError, match=r"more than 1\.3 MB"):
        replay(scene)


def test_views_of_results_are_pages(tmp_path, monkeypatch, lump):
    aligned = regkit.align(lump, lump + np.array([0.02, 0.0, 0.0]))
    view = aligned.view(height=300)
    clouds = {one["name"]: one for one in embedded(view.html())["recordings"][0]["clouds"]}
    assert set(clouds) == {"target", "source", "result"}
    frame = view._repr_html_()
    assert frame.startswith("<iframe srcdoc=")
    assert "height: 300px" in frame
    assert "<html" not in frame  # It is escaped.
    view.save(tmp_path / "scene.html")
    assert (tmp_path / "scene.html").read_text("utf-8") == view.html()
    opened = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    assert view.open().as_uri() == opened[0]
    assert ".save" in repr(view)
    with pytest.raises(ConfigError, match=r"scene\.png.*\.html"):
        view.save("scene.png")
    with pytest.raises(ConfigError, match="height"):
        SceneView(view.scene, 0)


def test_part_of_a_track_is_viewed_with_its_own_frames():
    walk = regkit.load_recording("docs/examples/data/human_walk", frames=6)
    start = {
        "kind": "given",
        "root": {"position": [-0.05, -0.05, 3.25], "rotation_deg": [180, 0, 0]},
    }
    tracked = regkit.track(walk, regkit.load_template("human", height=1.63), start=start)
    (whole,) = tracked.view(walk.truth()).scene.recordings
    assert whole.frames.tolist() == [0, 1, 2, 3, 4, 5]
    assert whole.joints == walk.truth().joints
    (part,) = tracked[2:5].view().scene.recordings
    assert part.length == 3
    for at in range(3):
        np.testing.assert_allclose(part.points.at(at), whole.points.at(at + 2), atol=2e-3)
    (method,) = part.methods
    np.testing.assert_allclose(method.track.transforms[1, :, 4:], tracked.segments[3, :, :3, 3])
    (one,) = tracked[4].view().scene.recordings
    assert one.frames.tolist() == [0]
    # Points that were not kept are read again.
    tracked.recorder.sample.points.clear()
    (again,) = tracked[2:5].view().scene.recordings
    np.testing.assert_allclose(again.points.at(1), part.points.at(1), atol=2e-3)
