"""``regkit view``: what it shows, and how it ends."""

import json
import shutil
import signal
import time
from urllib.request import urlopen

import numpy as np
import pytest
from made_tracks import made_scene
from places import DATA
from small_experiment import small

from regkit.clouds import write_cloud
from regkit.experiment import Experiment, run
from regkit.experiment.viewing import site_of
from regkit.system.errors import RegkitError
from regkit.viewer.packed import unpacked
from regkit.viewer.track_file import write_scene
from regkit_plugins.shapes.gsog import GeneralizedSumOfGaussians
from regkit_plugins.templates.human import Human

BODY = Human(height=1.7).body(1.7)
WALK = DATA / "human_walk"


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    files = small(tmp_path_factory.mktemp("viewed"))
    run(Experiment.read(files.experiment, ("dataset.frames=1",)), files.out, figures=False)
    # Another method costs nothing if it found the same.
    shutil.copytree(files.out / "gsog", files.out / "sog")
    return files.out


@pytest.fixture
def track(tmp_path):
    """A folder as ``regkit track`` leaves it."""
    folder = tmp_path / "walk"
    folder.mkdir()
    (folder / "result.json").write_text('{"method": "best"}')
    write_scene(made_scene(BODY, GeneralizedSumOfGaussians().bind(BODY), 5), folder)
    return folder


def shown(*arguments) -> dict:
    return json.loads(site_of(*arguments)("scene.json")[1])


def test_results_are_shown_with_the_methods_that_are_asked_for(results):
    scene = shown(results)
    assert [one["name"] for one in scene["recordings"]] == ["first", "second"]
    assert [one["name"] for one in scene["recordings"][0]["methods"]] == ["gsog", "sog"]
    (recording,) = shown(results, "second", ["sog"])["recordings"]
    assert recording["name"] == "second"
    assert [one["name"] for one in recording["methods"]] == ["sog"]
    (one,) = shown(results / "sog" / "second")["recordings"]
    assert one["methods"][0]["transforms"] == recording["methods"][0]["transforms"]


def test_folder_of_a_track_is_shown(track):
    (recording,) = shown(track)["recordings"]
    assert (recording["name"], recording["length"]) == ("walk", 5)
    assert [one["name"] for one in recording["methods"]] == ["best"]


def test_result_of_an_alignment_is_shown_with_its_clouds(regkit, tmp_path, lump):
    for name, cloud in (("a.npz", lump), ("b.npz", lump + np.array([0.05, 0.0, 0.0]))):
        write_cloud(tmp_path / name, cloud)
    ended = regkit("align", tmp_path / "a.npz", tmp_path / "b.npz", "--json")
    (tmp_path / "aligned.json").write_text(ended.out)
    (recording,) = shown(tmp_path / "aligned.json")["recordings"]
    clouds = {one["name"]: unpacked(one["positions"]) for one in recording["clouds"]}
    np.testing.assert_allclose(clouds["source"], lump, atol=1e-6)
    np.testing.assert_allclose(clouds["result"], clouds["target"], atol=2e-3)
    (alone,) = shown(tmp_path / "a.npz")["recordings"]
    assert unpacked(alone["clouds"][0]["positions"]).shape == lump.shape


def test_recording_is_shown_with_its_reference_joints():
    (recording,) = shown(DATA, "human_walk")["recordings"]
    assert recording["length"] == len(recording["frames"]) == 60
    assert unpacked(recording["joints"]["positions"]).shape[0] == 60
    kind, content = site_of(WALK)("points/0/59")
    assert kind == "application/octet-stream"
    assert len(content) > 16


def test_what_cannot_be_shown_is_refused(results, track, tmp_path):
    (tmp_path / "empty").mkdir()
    (tmp_path / "other.json").write_text("{}")
    for arguments, expected in (
        ((tmp_path / "nothing",), "give the results of a run"),
        ((tmp_path / "empty",), "the folder or file of a recording"),
        ((tmp_path / "other.json",), "regkit align --json"),
        ((results, "third"), "--recording: no recording 'third'.*first, second"),
        ((results, None, ["sogg"]), "--method: no method 'sogg'.*did you mean"),
        ((track, None, ["best"]), "--method"),
        ((track, "third"), "--recording: no recording 'third'"),
        ((DATA,), "human_walk"),
    ):
        with pytest.raises(RegkitError, match=expected):
            site_of(*arguments)
    (track / "scene.npz").unlink()
    with pytest.raises(RegkitError, match="track again"):
        site_of(track)


def test_viewer_serves_until_it_is_interrupted(started, track):
    viewer = started("view", track, "--no-browser")
    address = viewer.process.stdout.readline().strip()
    assert address.startswith("http://127.0.0.1:")
    with urlopen(f"{address}scene.json", timeout=5) as answer:
        assert json.load(answer)["recordings"][0]["name"] == "walk"
    time.sleep(0.1)
    viewer.process.send_signal(signal.SIGINT)
    out, err = viewer.process.communicate(timeout=10)
    assert (viewer.process.returncode, out) == (0, "")
    assert "Traceback" not in err


def test_port_that_is_taken_is_told(regkit, started, track):
    viewer = started("view", track, "--no-browser")
    port = viewer.process.stdout.readline().strip().rstrip("/").rpartition(":")[2]
    ended = regkit("view", track, "--no-browser", "--port", port)
    assert ended.code == 1
    assert ended.err.startswith(f"error: --port: port {port}")


@pytest.mark.parametrize("suffix", [".gif", ".webp"])
def test_tracks_are_exported_as_animated_pictures(regkit, track, results, tmp_path, suffix):
    from PIL import Image

    ended = regkit("export", track, "--to", tmp_path / f"walk{suffix}")
    assert ended.code == 0, ended.err
    with Image.open(tmp_path / f"walk{suffix}") as image:
        assert (image.n_frames, image.width) == (5, 720)
    assert "frames: 5" in ended.out
    assert regkit("export", results / "sog" / "first", "--to", tmp_path / "one.gif").code == 0
    ended = regkit("export", results, "--to", tmp_path / "all.gif")
    assert ended.code == 1
    assert str(results / "gsog" / "first") in ended.err
