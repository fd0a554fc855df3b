"""``regkit align``: what it prints and writes, and how it ends."""

import json
import re

import numpy as np
import pytest
from places import DATA

from regkit.clouds import read_cloud, write_cloud
from regkit.geometry.rigid import inverse, rigid, transformed
from regkit.geometry.rotation import from_matrix, to_vector, vector_to_matrix

VIEWS = DATA / "mannequin" / "clouds"


@pytest.fixture
def truth():
    return rigid(vector_to_matrix(np.array([0.2, 0.1, -0.3])), np.array([0.5, 0.0, -0.2]))


@pytest.fixture
def clouds(tmp_path, lump, truth):
    source, target = tmp_path / "source.npz", tmp_path / "target.txt"
    write_cloud(source, lump[:1000])
    write_cloud(target, transformed(truth, lump[500:]))
    return source, target


def near(found, truth, degrees, metres):
    """Whether a motion is the true one at the lump."""
    off = inverse(truth) @ np.array(found)
    assert np.degrees(np.linalg.norm(to_vector(from_matrix(off[:3, :3])))) < degrees
    centre = np.array([[0.5, -0.2, 1.0]])
    assert np.linalg.norm(transformed(off, centre) - centre) < metres


def test_threads_change_nothing(regkit, clouds):
    alone, several = (
        json.loads(regkit("align", *clouds, "--json", *more).out) for more in ((), ("--threads", 2))
    )
    assert several["T_target_source"] == alone["T_target_source"]
    assert regkit("align", *clouds, "--threads", 0).code == 2


def test_table_tells_what_was_found(regkit, clouds):
    ended = regkit("align", *clouds, "--start", "nearest")
    assert ended.code == 0
    assert ended.err == ""
    for what in ("T_target_source", "fitness", "inlier RMSE", "overlap", "seconds", "converged"):
        assert what in ended.out
    assert "alignment of the centroids" in ended.out


def test_json_and_the_aligned_cloud_hold_the_motion(regkit, clouds, truth, tmp_path):
    source, target = clouds
    out = tmp_path / "aligned.csv"
    ended = regkit("align", source, target, "--json", "--out", out)
    assert ended.code == 0
    found = json.loads(ended.out)
    near(found["T_target_source"], truth, 0.5, 0.001)
    assert found["verdict"] == "found"
    assert found["fitness"] > 0.95
    assert found["points"] == [1000, 1000]
    aligned = transformed(np.array(found["T_target_source"]), read_cloud(source))
    np.testing.assert_allclose(read_cloud(out), aligned)
    assert ended.err == f"written: {out}\n"


def test_start_is_read_from_a_file(regkit, clouds, truth, tmp_path):
    start = tmp_path / "start.txt"
    np.savetxt(start, truth)
    found = json.loads(regkit("align", *clouds, "--start", start, "--json").out)
    assert found["start"] == f"the matrix in {start}"
    near(found["T_target_source"], truth, 0.5, 0.001)
    assert found["fitness_at_start"] > 0.95


def test_shipped_views_are_aligned(regkit):
    """The figure turns by 36 degrees about the vertical from the first to the fourth cloud."""
    ended = regkit("align", VIEWS / "000000.npz", VIEWS / "000003.npz", "--json")
    rotation = np.array(json.loads(ended.out)["T_target_source"])[:3, :3]
    turn = np.degrees(to_vector(from_matrix(rotation)))
    np.testing.assert_allclose(turn, [0.0, -36.0, 0.0], atol=2.0)


@pytest.mark.parametrize("start", ["auto", "rotations", "open3d_features"])
def test_any_orientation_is_found(regkit, tmp_path, lump, start):
    if start == "open3d_features":
        pytest.importorskip("open3d")
    turned = rigid(vector_to_matrix(np.array([0.5, 2.5, -1.0])), np.array([1.0, 2.0, 3.0]))
    files = tmp_path / "a.npz", tmp_path / "b.npz"
    for file, points in zip(files, (lump, transformed(turned, lump)), strict=True):
        write_cloud(file, points)
    found = json.loads(regkit("align", *files, "--start", start, "--json").out)
    near(found["T_target_source"], turned, 0.5, 0.001)


def test_no_alignment_is_an_error_that_says_so(regkit, clouds, tmp_path):
    far = tmp_path / "far.npz"
    write_cloud(far, read_cloud(clouds[1]) + 50.0)
    out = tmp_path / "aligned.npz"
    ended = regkit("align", clouds[0], far, "--start", "identity", "--json", "--out", out)
    assert ended.code == 3
    found = json.loads(ended.out)
    assert found["verdict"] == "lost"
    assert found["fitness"] == 0.0
    assert found["inlier_rmse"] is None
    assert "no alignment was found: 0 % of the source lies within" in ended.err
    assert not out.exists()


def test_surface_that_slides_along_itself_is_warned_of(regkit, tmp_path, random):
    ball = random.normal(size=(1500, 3))
    file = tmp_path / "ball.npz"
    write_cloud(file, ball / np.linalg.norm(ball, axis=1, keepdims=True))
    ended = regkit("align", file, file)
    assert ended.code == 0
    assert "warning: doubtful: a rotation about the direction" in ended.err
    assert regkit("align", file, file, "--strict").code == 3


@pytest.mark.parametrize(
    ("source", "options", "expected"),
    [
        ("nothing.ply", [], "nothing.ply: there is no such file"),
        ("two.txt", [], "two.txt: the cloud has 2 different points of 2; at least 10 are needed"),
        ("line.txt", [], "line.txt: all points lie on a line"),
        ("plane.txt", [], "plane.txt: all points lie in a plane"),
        ("nan.txt", [], "nan.txt: all 1500 points are missing measurements"),
        ("mm.txt", [], "the source is 435.9 large and the target 0.4359, a factor of 1e+03"),
        ("good.txt", ["--start", "centroid"], "--start: there is no file 'centroid'; name one "
         "with a 4x4 matrix, or one of auto, nearest, identity, centroids, features, kiss_matcher, "
         "open3d_features, rotations; did you mean 'centroids'?"),
        ("good.txt", ["--start", "two.txt"], "two.txt: 6 numbers; a 4x4 matrix has 16"),
        ("good.txt", ["--start", "scaled.txt"], "scaled.txt: the matrix is not a rigid motion"),
        ("good.txt", ["--method", "ipc"], "--method ipc: method: no plug-in 'ipc'"),
        ("good.txt", ["--method", "{kind: open3d_icp, distanse: 1}"],
         "method.distanse: no such field"),
        ("good.txt", ["--out", "a.doc"], "--out a.doc: the name must end with one of"),
        ("good.txt", ["--voxel", "3"], "--voxel: "),
    ],
)  # fmt: skip
def test_mistake_is_told_without_a_traceback(
    regkit, tmp_path, monkeypatch, lump, source, options, expected
):
    monkeypatch.chdir(tmp_path)
    flat, bad = lump.copy(), lump.copy()
    flat[:, 2] = 0.0
    bad[:, 1] = np.nan
    files = {
        "good": lump, "two": lump[:2], "plane": flat, "nan": bad, "mm": 1000.0 * lump,
        "line": np.outer(np.arange(30.0), [1, 2, 3]), "scaled": 2.0 * np.eye(4),
    }  # fmt: skip
    for name, rows in files.items():
        np.savetxt(f"{name}.txt", rows)
    ended = regkit("align", source, "good.txt", *options)
    assert ended.code == 1
    assert ended.out == ""
    assert ended.err.startswith("error: ")
    assert expected in ended.err


@pytest.mark.long
def test_rigid_and_jointed_methods_stand_in_one_experiment(regkit, tmp_path):
    """What a method cannot do is told; the others are run."""
    pytest.importorskip("open3d")
    example = VIEWS.parents[2] / "rigid.yaml"
    direct = "{kind: direct, shape: cloud_gsog, kernel: local_likelihood, solver: gauss_newton}"
    ended = regkit(
        "run", example, "--out", tmp_path / "out", "--no-figures", "--set", "dataset.frames=3",
        "--set", f"methods={{rigid: {{preset: rigid}}, icp: open3d_icp, direct: {direct}, "
        "best: {preset: best}}",
    )  # fmt: skip
    assert ended.code == 1
    assert "best on mannequin failed: the template 'model' has no capsules" in ended.err
    metrics = json.loads((tmp_path / "out" / "metrics.json").read_text())["methods"]
    errors = {name: one["mean"]["joint_error_raw_cm"] for name, one in metrics.items()}
    assert errors["rigid"] < 0.5
    assert errors["direct"] < 3.0
    assert errors["icp"] is not None
    assert metrics["rigid"]["mean"]["surface_distance_mm"] < 25.0
    assert (tmp_path / "out" / "rigid" / "mannequin" / "overlay.png").exists()


def test_rigid_method_on_a_jointed_body_is_told(regkit, tmp_path):
    pytest.importorskip("open3d")
    example = VIEWS.parents[2] / "demo.yaml"
    ended = regkit(
        "run", example, "--out", tmp_path / "out", "--no-figures", "--set", "dataset.frames=1",
        "--set", "methods={icp: open3d_icp}", "--set", "template={kind: human, height: 1.7}",
        "--set", "start={kind: given, root: {position: [0, 0, 3.25], rotation_deg: [180, 0, 0]}}",
    )  # fmt: skip
    assert ended.code == 1
    assert "method 'open3d_icp' is rigid, but the template 'human' has 15 segm" in ended.err
    report = (tmp_path / "out" / "report.md").read_text()
    assert "is rigid, but the template 'human' has 15 segments" in report


def test_printed_matrix_moves_far_points_as_the_result_does(regkit, tmp_path, lump):
    """Coordinates of maps are millions of metres, where six decimals of a rotation are metres."""
    points = 20.0 * lump + [539_700.0, 4_065_700.0, 10.0]
    centre = points.mean(axis=0)
    about = rigid(np.eye(3), centre) @ rigid(vector_to_matrix(np.array([0, 0, 0.05])), np.ones(3))
    truth = about @ rigid(np.eye(3), -centre)
    files = [tmp_path / "source.csv", tmp_path / "target.csv"]
    for file, cloud in zip(files, (points, transformed(truth, points)), strict=True):
        write_cloud(file, cloud)
    ended = regkit("align", *files, "--voxel", "0")
    # The matrix stands in the table or below it.
    numbers = re.findall(r"-?\d+\.\d+", ended.out.split("T_target_source")[-1])[:16]
    printed = np.array(numbers, dtype=float).reshape(4, 4)
    moved = transformed(printed, points)
    # The object is 9 m large, and the method stops within a few millimetres.
    assert np.abs(moved - transformed(truth, points)).max() < 5e-3
    found = json.loads(regkit("align", *files, "--voxel", "0", "--json").out)
    given = transformed(np.array(found["T_target_source"]), points)
    assert np.abs(moved - given).max() < 2e-4
    # The printed matrix is also a start.
    (tmp_path / "start.txt").write_text(" ".join(numbers))
    again = regkit("align", *files, "--start", tmp_path / "start.txt", "--voxel", "0", "--json")
    assert json.loads(again.out)["fitness_at_start"] == 1.0


def test_views_are_aligned_to_one_another(regkit, tmp_path, lump):
    """Each view is turned, and all are in the frame of the first one again."""
    files, truths = [], []
    order = np.argsort(lump[:, 0])
    for number, keep in enumerate((slice(0, 1100), slice(200, 1300), slice(400, 1500))):
        truths.append(rigid(vector_to_matrix(np.array([0.9 * number, 0.3, 0.0])), np.ones(3)))
        files.append(tmp_path / f"{number}.npz")
        write_cloud(files[-1], transformed(truths[-1], lump[order[keep]]))
    ended = regkit("align", "--all", *files, "--json", "--out", tmp_path / "merged.npz")
    assert ended.code == 0
    found = json.loads(ended.out)
    assert found["world"] == str(files[0])
    for file, truth in zip(files, truths, strict=True):
        moved = np.array(found["T_world_view"][str(file)]) @ truth
        np.testing.assert_allclose(
            transformed(moved, lump), transformed(truths[0], lump), atol=0.01
        )
    assert len(read_cloud(tmp_path / "merged.npz")) == 3300
    assert regkit("align", *files).code == 2


def test_symmetric_objects_have_a_rival(regkit, tmp_path, lump, random):
    """A body that is the same after half a turn has two transforms, and both are told."""
    half = lump - lump.mean(axis=0) + [0.12, 0.0, 0.0]
    both = np.concatenate([half, half * [-1.0, -1.0, 1.0]])
    turned = rigid(vector_to_matrix(np.array([0.4, -1.0, 2.0])), np.ones(3))
    files = tmp_path / "a.npz", tmp_path / "b.npz"
    noise = 1e-4 * random.normal(size=both.shape)
    for file, points in zip(files, (both, transformed(turned, both + noise)), strict=True):
        write_cloud(file, points)
    ended = regkit("align", *files, "--json")
    assert ended.code == 0
    found = json.loads(ended.out)
    assert found["verdict"] == "doubtful"
    assert found["rivals"]
    assert "another transform, 180 degrees away" in ended.err


@pytest.mark.parametrize("shared", [True, False])
def test_a_rough_plane_that_slides_in_itself_is_doubtful(regkit, random, tmp_path, shared):
    source, other = (
        np.column_stack([random.uniform(-0.5, 0.5, (1000, 2)), 0.01 * random.normal(size=1000)])
        for _ in range(2)
    )
    np.savetxt(tmp_path / "a.xyz", source)
    np.savetxt(tmp_path / "b.xyz", (source if shared else other) + [0.1, 0.05, 0.0])
    ended = regkit("align", tmp_path / "a.xyz", tmp_path / "b.xyz", "--strict")
    assert ended.code == 3
    assert "slides its surface along itself" in ended.err
