"""The shape of a body in a scan: found from nothing, written, and refused where it cannot be."""

import json

import numpy as np
import pytest
import trimesh

import regkit
from regkit.body.linear_shape import LinearShape
from regkit.body.reading import description_in
from regkit.calibration.skin.posed_skin import PosedSkin
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.skeleton import Pose
from regkit.system.errors import ConfigError
from regkit_plugins.templates.hand import Hand

SHAPE = LinearShape.of(Hand().description())


@pytest.fixture(scope="module")
def scan() -> np.ndarray:
    """A whole hand, 7 % longer than the template's and turned, as points on its surface."""
    random = np.random.default_rng(0)
    x = SHAPE.at_size(1.07 * SHAPE.template.size.value)
    bones = SHAPE.skeleton(x)
    rest = bones.rest(
        rigid(vector_to_matrix(np.array([2.0, 0.5, 1.0])), np.array([0.1, -0.2, 0.6]))
    )
    vertices = PosedSkin.of(SHAPE, x, Pose(rest.root, rest.balls, rest.hinges)).vertices
    corners = vertices[SHAPE.mesh.faces[random.integers(len(SHAPE.mesh.faces), size=3000)]]
    return np.einsum("nc,nci->ni", random.dirichlet(np.ones(3), 3000), corners)


@pytest.fixture(scope="module")
def found(scan) -> regkit.ShapedBody:
    return regkit.fit_shape(scan, "hand")


def test_shape_of_a_scan_lies_on_it(found):
    assert found.registration.verdict is regkit.Verdict.FOUND
    assert np.median(found.data_to_skin) < 1e-3
    assert found.size == pytest.approx(1.07 * SHAPE.template.size.value, rel=0.02)


def test_mesh_of_a_shape_has_the_templates_vertices(found, tmp_path):
    found.save_mesh(tmp_path / "hand.ply")
    read = trimesh.load(tmp_path / "hand.ply", process=False)
    np.testing.assert_array_equal(read.faces, SHAPE.mesh.faces)
    np.testing.assert_allclose(read.vertices, found.vertices, atol=1e-6)
    with pytest.raises(ConfigError, match=r"\.ply \.obj"):
        found.save_mesh(tmp_path / "hand.docx")


def test_template_of_a_shape_has_its_size(found, tmp_path):
    found.save_template(tmp_path / "mine.yaml")
    again = description_in(tmp_path / "mine.yaml")
    assert again.size.value == pytest.approx(found.size, abs=1e-4)


def test_template_without_modes_cannot_be_shaped(scan):
    with pytest.raises(ConfigError, match="no shape modes"):
        regkit.fit_shape(scan, {"kind": "human", "build": "small"})


@pytest.mark.long
def test_command_writes_mesh_template_and_distances(scan, regkit, tmp_path):
    np.savetxt(tmp_path / "scan.xyz", scan)
    mesh, out = tmp_path / "hand.obj", tmp_path / "out"
    ended = regkit(
        "register", tmp_path / "scan.xyz", "--template", "hand", "--mesh", mesh, "--out", out
    )
    assert ended.code == 0, ended.err
    assert "data to skin" in ended.out
    assert len(trimesh.load(mesh, process=False).vertices) == len(SHAPE.mesh.vertices)
    figures = json.loads((out / "result.json").read_text())["shape"]
    assert figures["data_to_skin_mm"]["median"] < 1.0
    assert set(figures["coefficients"]) == set(SHAPE.names[: SHAPE.modes])
    assert regkit("validate", out / "shape.yaml").code == 0


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (("--mesh", "hand.docx"), ".glb"),
        (("--mesh", "hand.ply", "--no-shape"), "--no-shape"),
        (("--shape", "--template", "{kind: human, build: tall}"), "no shape modes"),
    ],
)
def test_command_refuses_what_cannot_be_shaped(scan, regkit, tmp_path, options, told):
    np.savetxt(tmp_path / "scan.xyz", scan)
    ended = regkit("register", tmp_path / "scan.xyz", *options)
    assert ended.code == 1
    assert told in ended.err
