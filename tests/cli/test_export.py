"""``regkit export``: the motion in a results folder, for other programs."""

import csv
import shutil
from pathlib import Path

import numpy as np
import pytest
from messages import tells
from small_experiment import QUICK

from regkit.body import BodyDescription
from regkit.config.document import Document
from regkit.experiment.provenance.manifest import Manifest
from regkit.interchange.bvh.bvh import Bvh
from regkit.interchange.gltf.gltf import RiggedBody
from regkit_plugins.templates.human import Human

UPRIGHT = np.diag([1.0, -1.0, -1.0])


@pytest.fixture
def tracked(regkit, files) -> Path:
    """The folder of a recording of one frame."""
    ended = regkit("run", files.experiment, "--out", files.out, *QUICK)
    assert ended.code == 0, ended.err
    return files.out / "gsog" / "first"


def markers(folder: Path) -> dict[str, np.ndarray]:
    with np.load(folder / "poses.npz") as arrays:
        return dict(zip(arrays["marker_names"], arrays["markers"][0], strict=True))


def rewrite(file: Path, **changed: object) -> None:
    """Change arrays of a finished track's file, and its checksum with it; None removes one."""
    with np.load(file) as arrays:
        kept = {name: arrays[name] for name in arrays.files if name not in changed}
    np.savez(file, **kept, **{name: one for name, one in changed.items() if one is not None})
    Manifest.of(file.parent, "").write(file.parent)


def test_all_formats_hold_the_tracked_motion(regkit, tmp_path, tracked):
    for name in ("motion.bvh", "large.bvh", "motion.csv", "motion.glb"):
        unit = ("--unit", "cm") if name == "large.bvh" else ()
        ended = regkit("export", tracked, "--to", tmp_path / name, *unit)
        assert ended.code == 0, ended.err
        assert f"written: {tmp_path / name} (frames: 1, 30 per second; segments: 15)" in ended.out
    truth = markers(tracked)
    for name, scale in (("motion.bvh", 1.0), ("large.bvh", 0.01)):
        motion = Bvh.read(tmp_path / name, scale=scale)
        places = dict(zip(motion.names, motion.at_frame(0).positions, strict=True))
        for segment, marker in (("left_forearm", "left_elbow"), ("right_foot", "right_ankle")):
            np.testing.assert_allclose(places[segment], UPRIGHT @ truth[marker], atol=1e-6)
    with (tmp_path / "motion.csv").open(newline="") as stream:
        rows = [row for row in csv.DictReader(stream) if row["kind"] == "marker"]
    for row in rows:
        place = [float(row[axis]) for axis in "xyz"]
        np.testing.assert_allclose(place, truth[row["name"]], atol=1e-7)
    body = RiggedBody.read(tmp_path / "motion.glb")
    starts = dict(zip(body.mesh.labels, body.clips[0].at(0.0)[:, :3, 3], strict=True))
    np.testing.assert_allclose(starts["left_shin"], UPRIGHT @ truth["left_knee"], atol=1e-5)


@pytest.mark.long
def test_an_exported_body_is_fitted_again_without_a_map(regkit, tmp_path, tracked):
    assert regkit("export", tracked, "--to", tmp_path / "body.glb").code == 0
    ended = regkit("fit", tmp_path / "body.glb", "--out", tmp_path / "again.yaml")
    assert ended.code == 0, ended.err
    again = Document.read(tmp_path / "again.yaml").validated(BodyDescription)
    body = Human(height=1.7).body(1.7)
    rest = body.place(body.skeleton.rest()).transforms[:, :3, 3]
    for segment, parent in (("left_shin", "left_thigh"), ("right_hand", "right_forearm")):
        pair = [body.skeleton.names.index(name) for name in (segment, parent)]
        length = np.linalg.norm(rest[pair[0]] - rest[pair[1]])
        assert np.linalg.norm(again.segments[segment].offset) == pytest.approx(length, abs=2e-4)


def test_frames_per_second_can_be_given(regkit, tmp_path, tracked):
    ended = regkit("export", tracked, "--to", tmp_path / "motion.bvh", "--fps", 12.5)
    assert ended.code == 0, ended.err
    assert Bvh.read(tmp_path / "motion.bvh").frame_time == pytest.approx(0.08)


def test_results_without_a_rate_need_one(regkit, tmp_path, tracked):
    rewrite(tracked / "record.npz", fps=None)
    ended = regkit("export", tracked, "--to", tmp_path / "motion.bvh")
    assert ended.code == 1
    assert ended.err.startswith("error: --fps: ")
    assert "frames" in ended.err
    assert regkit("export", tracked, "--to", tmp_path / "motion.bvh", "--fps", 5).code == 0
    rewrite(tracked / "record.npz", fps=20.0)
    assert regkit("export", tracked, "--to", tmp_path / "motion.bvh").code == 0
    assert Bvh.read(tmp_path / "motion.bvh").frame_time == pytest.approx(0.05)


def test_poses_of_no_template_of_the_run_are_refused(regkit, tmp_path, tracked):
    with np.load(tracked / "poses.npz") as arrays:
        rewrite(tracked / "poses.npz", markers=arrays["markers"] + 0.01)
    ended = regkit("export", tracked, "--to", tmp_path / "motion.bvh")
    assert ended.code == 1
    assert tells(ended.err, at=str(tracked), of=("template", "markers"))


@pytest.mark.filterwarnings("default::regkit.system.notes.RegkitWarning")
def test_motion_is_exported_without_the_templates_files(regkit, tmp_path, files):
    """The results hold what is needed of the template but for its mesh, which is told."""
    shipped, mesh = Human().description().mesh, "human_mesh.npz"
    assert shipped is not None
    for name in ("human.yaml", mesh):
        shutil.copy(shipped.with_name(name), tmp_path / name)
    template = f"template={{kind: file, path: {tmp_path}/human.yaml, size: 1.7}}"
    ended = regkit("run", files.experiment, "--out", files.out, *QUICK, "--set", template)
    assert ended.code == 0, ended.err
    track = files.out / "gsog" / "first"
    whole, alone = (tmp_path / name for name in ("whole.bvh", "alone.bvh"))
    assert regkit("export", track, "--to", whole).err == ""
    (tmp_path / mesh).unlink()
    ended = regkit("export", track, "--to", alone)
    assert ended.code == 0, ended.err
    assert ended.err.startswith("warning: ")
    assert whole.read_text() == alone.read_text()
    (tmp_path / "human.yaml").unlink()
    assert regkit("export", track, "--to", tmp_path / "alone.glb").code == 0


def test_what_is_no_result_is_refused(regkit, tmp_path, tracked):
    ended = regkit("export", tracked.parents[1], "--to", tmp_path / "motion.bvh")
    assert ended.code == 1
    assert f"there are: {tracked}" in ended.err
    ended = regkit("export", tracked, "--to", tmp_path / "motion.fbx")
    assert ended.code == 1
    assert "--to: '.fbx' is not an export format (.bvh, .csv, .glb, .gif, .webp)" in ended.err
    copy = tmp_path / "other" / "gsog" / "first"
    shutil.copytree(tracked, copy)
    ended = regkit("export", copy, "--to", tmp_path / "motion.bvh")
    assert ended.code == 1
    assert f"{tmp_path / 'other' / 'setup.json'}: there is no such file" in ended.err
    (tracked / "poses.npz").write_bytes(b"PK")
    ended = regkit("export", tracked, "--to", tmp_path / "motion.bvh")
    assert ended.code == 1
    assert "poses.npz: damaged" in ended.err
    assert not (tmp_path / "motion.bvh").exists()
