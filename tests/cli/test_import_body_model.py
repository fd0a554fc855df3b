"""``regkit import`` of parametric body models."""

from pathlib import Path

import numpy as np
import pytest
from body_models import body_arrays, python2_pickle, sparse, write_npz

from regkit.body import BodyDescription
from regkit.body.modes import Modes
from regkit.config.document import Document
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.errors import RegkitError


@pytest.fixture
def model(tmp_path):
    return write_npz(tmp_path / "smpl.npz", body_arrays())


def test_a_body_model_becomes_a_template_with_skin_and_modes(regkit, tmp_path, model):
    out = tmp_path / "body.yaml"
    ended = regkit("import", model, "--out", out, "--modes", 2, "--shape", "gsog")
    assert ended.code == 0, ended.err
    assert "segments: 24 (23 ball)" in ended.out
    assert "skin: 480 vertices; shape modes: 2 of 3; height: 1.653 m" in ended.out
    beside = [tmp_path / "body_mesh.npz", tmp_path / "body_modes.npz"]
    assert f"written: {out} and {beside[0]} and {beside[1]}" in ended.out
    assert regkit("validate", out).code == 0
    text = out.read_text()
    assert text.startswith("# Made by `regkit import smpl.npz --modes 2 --shape gsog`.")
    assert "have no limits" not in text
    description = Document.read(out).validated(BodyDescription)
    assert (description.mesh, description.modes) == (beside[0], beside[1])
    assert len(description.shapes["gsog"]) == 24
    modes = Modes.read(beside[1])
    assert modes.names == ("beta_1", "beta_2")
    assert modes.labels == SkinnedMesh.read(beside[0]).labels == tuple(description.segments)
    np.testing.assert_array_equal(modes.covariance, np.eye(2))


def test_vertices_are_kept_with_their_modes(regkit, tmp_path):
    grid, around = np.meshgrid(np.linspace(0.0, 1.0, 20), np.arange(12) * np.pi / 6, indexing="ij")
    tube = np.stack([0.2 * np.cos(around), grid, 0.2 * np.sin(around)], axis=-1).reshape(-1, 3)
    rows, columns = np.meshgrid(np.arange(19), np.arange(12), indexing="ij")
    corners = [12 * (rows + a) + (columns + b) % 12 for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
    faces = np.stack(corners, axis=-1).reshape(-1, 4)
    lower = (tube[:, 1] < 0.5).astype(float)
    model = {
        "v_template": tube,
        "f": np.concatenate([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]]),
        "weights": np.stack([lower, 1.0 - lower], axis=1),
        "kintree_table": np.array([[-1, 0], [0, 1]]),
        "J_regressor": np.stack([lower / lower.sum(), (1.0 - lower) / (1.0 - lower).sum()]),
        "shapedirs": 0.1 * tube[..., None],
    }
    path, out = write_npz(tmp_path / "tube.npz", model), tmp_path / "tube.yaml"
    ended = regkit("import", path, "--out", out, "--vertices", 60)
    assert ended.code == 0, ended.err
    description = Document.read(out).validated(BodyDescription)
    skin, modes = SkinnedMesh.read(description.mesh), Modes.read(description.modes)
    assert modes.vertices.shape == (1, 60, 3)
    root = model["J_regressor"][0] @ tube
    np.testing.assert_allclose(modes.vertices[0], 0.1 * (skin.vertices + root), atol=1e-6)


def test_a_model_without_modes_has_no_file_of_them(regkit, tmp_path, model):
    out = tmp_path / "body.yaml"
    assert regkit("import", model, "--out", out, "--modes", 0).code == 0
    assert not (tmp_path / "body_modes.npz").exists()
    assert Document.read(out).validated(BodyDescription).modes is None


def test_modes_of_another_mesh_are_refused_with_file_and_field(regkit, tmp_path, model):
    out = tmp_path / "body.yaml"
    regkit("import", model, "--out", out)
    other = tmp_path / "other.yaml"
    regkit("import", write_npz(tmp_path / "x.npz", body_arrays("SMPL-H")), "--out", other)
    text = out.read_text()
    for line, wrong in (
        ('modes: "body_modes.npz"', 'modes: "other_modes.npz"'),
        ('mesh: "body_mesh.npz"', ""),
    ):
        out.write_text(text.replace(line, wrong))
        with pytest.raises(RegkitError) as raised:
            Document.read(out).validated(BodyDescription)
        assert f"{out}:" in str(raised.value)
        assert "modes" in str(raised.value)
        assert regkit("validate", out).code == 1


@pytest.mark.long
def test_a_body_model_is_fitted_by_another_template(regkit, tmp_path):
    person = SkinnedMesh.read(Path("plugins/regkit_plugins/templates/human_mesh.npz"))
    vertices, joints = person.vertices, person.rest[:, :3, 3]
    weights, regressor = np.zeros((2, len(vertices), len(joints)))
    np.add.at(weights, (np.arange(len(vertices))[:, None], person.indices), person.weights)
    for joint, place in enumerate(joints):
        near = np.argsort(np.linalg.norm(vertices - place, axis=1))[:60]
        system = np.vstack([vertices[near].T, np.ones(60)])
        regressor[near, joint] = np.linalg.lstsq(system, np.append(place, 1.0), rcond=None)[0]
    model = write_npz(
        tmp_path / "model.npz",
        {
            "v_template": vertices,
            "f": person.faces,
            "weights": weights,
            "kintree_table": np.array([person.parents, range(len(joints))]),
            "J_regressor": regressor.T,
            "shapedirs": 0.05 * vertices[..., None],
            "joint2num": {label: joint for joint, label in enumerate(person.labels)},
        },
    )
    out = tmp_path / "fitted.yaml"
    ended = regkit("fit", model, "--template", "human", "--out", out, "--vertices", 300)
    assert ended.code == 0, ended.err
    assert "300 vertices; 1 shape modes" in ended.out
    description = Document.read(out).validated(BodyDescription)
    assert description.modes is not None
    skin, modes = SkinnedMesh.read(description.mesh), Modes.read(description.modes)
    # The mode stretches everything by 5 %, from wherever the root is.
    root = modes.joints[0, modes.labels.index("pelvis")]
    np.testing.assert_allclose(modes.vertices[0] - root, 0.05 * skin.vertices, atol=1e-5)
    order = [modes.labels.index(label) for label in skin.labels]
    origins = 0.05 * skin.rest[:, :3, 3]
    np.testing.assert_allclose(modes.joints[0, order] - root, origins, atol=1e-5)


def test_a_pickle_that_asks_to_run_something_is_refused(regkit, tmp_path):
    out, made = tmp_path / "body.yaml", tmp_path / "made"
    path = tmp_path / "smpl.pkl"
    command = f"touch {made}".encode()
    attack = b"cos\nsystem\nU" + bytes([len(command)]) + command + b"\x85R"
    content = python2_pickle({**body_arrays(), "J_regressor": sparse(np.eye(2)), "extra": 7})
    path.write_bytes(content.replace(b"J\x07\x00\x00\x00u.", attack + b"u."))
    ended = regkit("import", path, "--out", out)
    assert ended.code == 1
    assert f"{path}: the pickle asks to run 'os.system'" in ended.err
    assert not made.exists()
    assert not out.exists()
    assert [one.name for one in tmp_path.iterdir()] == ["smpl.pkl"]


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (("none.pkl",), "none.pkl: there is no such file"),
        (("mhr_model.pt",), "'.pt' cannot be imported; use .bvh, .urdf, or a body model"),
        (("a.bvh", "--modes", 3), "--modes: a.bvh is no body model"),
        (("a.urdf", "--vertices", 300), "--vertices: a.urdf is no body model"),
        (("a.npz", "--shape", "ghost"), "--shape ghost: no plug-in 'ghost'"),
        (("a.npz", "--up", "w"), "--up: 'w' is not an axis"),
    ],
)
def test_what_cannot_be_imported_is_refused(regkit, tmp_path, arguments, complaint):
    ended = regkit("import", *arguments, "--out", tmp_path / "body.yaml")
    assert ended.code == 1
    assert complaint in ended.err
    assert not (tmp_path / "body.yaml").exists()
