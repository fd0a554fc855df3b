"""Ray casting, the folder format, and the sample recordings that ship with regkit."""

from __future__ import annotations

import csv
import re
import sys
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image
from places import DATA
from ruamel.yaml import YAML

from regkit.geometry.camera import Camera
from regkit.system.errors import DataError
from regkit_synthesis.__main__ import main
from regkit_synthesis.assets import ASSETS
from regkit_synthesis.recordings.recording import DepthRecording
from regkit_synthesis.recordings.scene import SR4000
from regkit_synthesis.samples.depth import hand_gestures, human_walk

SHIPPED = DATA
SAMPLES = {"human_walk": human_walk, "hand_gestures": hand_gestures}
SMALL = Camera(width=20, height=16, fx=20.0, fy=20.0, cx=9.5, cy=7.5)


@pytest.fixture(scope="module", params=list(SAMPLES))
def sample(request):
    return SAMPLES[request.param](0)


def _tiny():
    return DepthRecording(
        name="tiny: a test",
        fps=30.0,
        depth_scale=1000.0,
        source='made "here"',
        licence="none",
        camera=SMALL,
        depth=np.arange(640, dtype=np.uint16).reshape(2, 16, 20),
        joints=("a", "b"),
        truth=np.arange(12.0).reshape(2, 2, 3) / 7.0,
    )


def _files(folder):
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*.*")}


def test_assets_of_others_have_the_licences_beside_them_that_the_table_names():
    rows = (ASSETS / "README.md").read_text().partition("## ")[0]
    for folder in sorted(path for path in ASSETS.iterdir() if path.is_dir()):
        licences = {path.name for path in folder.glob("LICENSE*")}
        assert licences or folder.name in ("keyframes", "gestures", "__pycache__")
        assert all(f"`{name}`" in rows for name in licences), folder.name
    for name in re.findall(r"`(LICENSE\S*)`", rows):
        assert list(ASSETS.glob(f"*/{name}")), name
    # That of DeepMimic, whose clips pybullet ships, is not pybullet's.
    clips = {path.name for path in (ASSETS / "humanoid_pybullet").glob("LICENSE*")}
    assert clips == {"LICENSE.txt", "LICENSE_DeepMimic_MIT"}


def test_written_recording_reads_back(tmp_path):
    recording = _tiny()
    recording.write(tmp_path / "tiny")
    header = YAML(typ="safe").load((tmp_path / "tiny" / "sequence.yaml").read_text())
    assert header == {
        "name": "tiny: a test",
        "fps": 30,
        "depth_scale": 1000,
        "source": 'made "here"',
        "licence": "none",
    }
    assert Camera.read(tmp_path / "tiny" / "camera.json") == SMALL
    for frame, image in enumerate(recording.depth):
        with Image.open(tmp_path / "tiny" / "depth" / f"{frame:06d}.png") as stored:
            assert stored.mode == "I;16"
            assert np.array_equal(np.asarray(stored), image)
    rows = list(csv.DictReader((tmp_path / "tiny" / "truth.csv").read_text().splitlines()))
    assert [(row["frame"], row["joint"]) for row in rows[:3]] == [
        ("0", "a"),
        ("0", "b"),
        ("1", "a"),
    ]
    assert np.allclose(
        [[float(row[axis]) for axis in "xyz"] for row in rows],
        recording.truth.reshape(-1, 3),
        atol=5e-7,
    )


def test_writing_again_replaces_the_recording_and_leaves_nothing_behind(tmp_path):
    _tiny().write(tmp_path / "tiny")
    shorter = replace(_tiny(), depth=_tiny().depth[:1], truth=_tiny().truth[:1])
    shorter.write(tmp_path / "tiny")
    assert [path.name for path in (tmp_path / "tiny" / "depth").iterdir()] == ["000000.png"]
    assert [path.name for path in tmp_path.iterdir()] == ["tiny"]


def test_a_failed_write_leaves_the_old_recording(tmp_path):
    _tiny().write(tmp_path / "tiny")
    before = _files(tmp_path / "tiny")
    with pytest.raises(ValueError, match="zip"):
        replace(_tiny(), joints=("a",)).write(tmp_path / "tiny")
    assert _files(tmp_path / "tiny") == before
    assert [path.name for path in tmp_path.iterdir()] == ["tiny"]


def test_writing_over_something_else_is_refused(tmp_path):
    (tmp_path / "photos").mkdir()
    (tmp_path / "photos" / "cat.png").write_text("")
    with pytest.raises(DataError, match=r"photos: it exists and is not a depth recording"):
        _tiny().write(tmp_path / "photos")
    assert (tmp_path / "photos" / "cat.png").exists()


def test_sample_stays_inside_the_image(sample):
    seen = sample.depth > 0
    assert seen.any(axis=(1, 2)).all()
    assert not seen[:, [0, -1]].any()
    assert not seen[:, :, [0, -1]].any()


def test_sample_joints_lie_in_the_body(sample):
    behind, inside = [], 0
    for image, joints in zip(sample.depth, sample.truth, strict=True):
        columns, rows = np.rint(SR4000.camera.projected(joints)).astype(int).T
        hit = image[rows, columns] > 0
        inside += int(hit.sum())
        behind.append((joints[:, 2] - image[rows, columns] / sample.depth_scale)[hit])
    depths = np.concatenate(behind)
    # A finger tip is a point of the skin: it may miss the silhouette by a pixel, and that pixel may
    # show what is behind it.
    assert inside > 0.9 * sample.truth[:, :, 0].size
    assert depths.mean() > SR4000.noise
    assert np.quantile(depths, 0.02) > -3.0 * SR4000.noise


def test_sample_moves_without_jumps(sample):
    steps = np.diff(sample.truth, axis=0)
    limits = {"human_walk": (0.11, 0.05), "hand_gestures": (0.02, 0.005)}
    fastest, jerkiest = limits[sample.name]
    assert np.linalg.norm(steps, axis=-1).max() < fastest
    assert np.linalg.norm(np.diff(steps, axis=0), axis=-1).max() < jerkiest


def test_sample_differs_only_in_noise_for_another_seed(sample):
    other = SAMPLES[sample.name](1)
    assert np.array_equal(other.truth, sample.truth)
    seen = sample.depth > 0
    assert np.array_equal(other.depth > 0, seen)
    difference = (other.depth.astype(float) - sample.depth)[seen] / sample.depth_scale
    assert difference.std() == pytest.approx(np.sqrt(2.0) * SR4000.noise, rel=0.02)


def test_walker_faces_the_camera():
    walk = human_walk(0)
    position = dict(zip(walk.joints, walk.truth.mean(axis=0), strict=True))
    for joint in ("shoulder", "hip"):
        assert position[f"left_{joint}"][0] > position[f"right_{joint}"][0]
    assert position["head"][1] < position["neck"][1] < position["pelvis"][1]  # y points down
    assert position["left_foot"][2] < position["left_ankle"][2]


def test_hand_shows_its_palm():
    hand = hand_gestures(0)
    position = dict(zip(hand.joints, hand.truth[0], strict=True))
    assert position["little_mcp"][0] < position["index_mcp"][0] < position["thumb_tip"][0]
    assert position["middle_tip"][1] < position["wrist"][1]


@pytest.mark.long
def test_main_makes_the_same_bytes_twice(tmp_path, monkeypatch, capsys):
    for run in ("first", "second"):
        monkeypatch.setattr(sys, "argv", ["synthesis", str(tmp_path / run)])
        assert main() == 0
    assert _files(tmp_path / "first") == _files(tmp_path / "second")
    assert "human_walk" in capsys.readouterr().out


def test_main_reports_an_error_without_a_traceback(tmp_path, monkeypatch, capsys):
    (tmp_path / "human_walk").mkdir()
    monkeypatch.setattr(sys, "argv", ["synthesis", str(tmp_path)])
    assert main() == 1
    assert "error: " in capsys.readouterr().err


def test_shipped_sample_is_what_the_script_makes(sample, tmp_path):
    sample.write(tmp_path / sample.name)
    made, shipped = _files(tmp_path / sample.name), _files(SHIPPED / sample.name)
    assert made.keys() == shipped.keys()
    for path in made:
        if path.suffix != ".png":
            assert made[path] == shipped[path], path
    images = []
    for frame in range(len(sample.depth)):
        with Image.open(SHIPPED / sample.name / "depth" / f"{frame:06d}.png") as image:
            images.append(np.asarray(image))
    # On another processor Open3D may decide otherwise where a ray just touches an outline.
    assert (np.array(images) != sample.depth).sum() <= 10


def test_shipped_samples_are_small():
    assert sum(path.stat().st_size for path in SHIPPED.rglob("*.*") if path.is_file()) < 3_000_000
