"""Meshes that a template does not fit: the other side's, and those of other units."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from places import CASES, EXAMPLES

from regkit.body import BodyDescription
from regkit.config.document import Document
from regkit.fitting.bones import read_bone_map
from regkit.fitting.template import FittedTemplate
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interchange.meshes import read_mesh
from regkit.system.errors import DataError
from regkit_plugins.templates import FOLDER
from regkit_synthesis import assets

MAPS = EXAMPLES / "maps"


def _template(name: str) -> BodyDescription:
    return Document.read(FOLDER / f"{name}.yaml").validated(BodyDescription)


def _exchanged(bones: dict[str, str | None]) -> dict[str, str | None]:
    """A map with left and right exchanged."""
    sides = {"left": "right", "right": "left"}

    def other(segment: str | None) -> str | None:
        side, _, rest = (segment or "").partition("_")
        return f"{sides[side]}_{rest}" if side in sides else segment

    return {bone: other(segment) for bone, segment in bones.items()}


def _mirrored(mesh: SkinnedMesh) -> SkinnedMesh:
    """The mirror image of a mesh, whose bones keep their names."""
    mirror = np.diag([-1.0, 1.0, 1.0, 1.0])
    return replace(
        mesh,
        vertices=mesh.vertices @ mirror[:3, :3],
        faces=mesh.faces[:, ::-1],
        rest=mirror @ mesh.rest @ mirror,
    )


def _fit(
    mesh: SkinnedMesh, name: str, bones: dict[str, str | None], vertices: int = 200
) -> FittedTemplate:
    return FittedTemplate.to(mesh, _template(name), bones, vertices)


def test_the_sides_of_the_case_are_told_apart(reference_data: Path) -> None:
    mesh = read_mesh(reference_data / "cesiumman_ccby" / "CesiumMan.glb")
    with pytest.raises(DataError, match="left and right"):
        _fit(mesh, "human", read_bone_map(CASES / "15-sides" / "swapped_all.yaml"))
    fitted = _fit(mesh, "human", read_bone_map(CASES / "15-sides" / "map.yaml"), 1500)
    assert fitted.description.size.value == pytest.approx(1.515, abs=0.002)


def test_exchanged_sides_are_refused_for_every_body() -> None:
    bones = _exchanged(read_bone_map(MAPS / "anny_body.yaml"))
    with pytest.raises(DataError, match="left and right"):
        _fit(assets.small_human(), "human", bones)
    own = SkinnedMesh.read(FOLDER / "human_mesh.npz")
    with pytest.raises(DataError, match="left and right"):
        _fit(own, "human", _exchanged({label: label for label in own.labels}))


def test_a_hand_of_the_other_side_is_refused(reference_data: Path) -> None:
    left = read_mesh(reference_data / "webxr_generic_hand_mit" / "left.glb")
    with pytest.raises(DataError, match="other side"):
        _fit(left, "hand_right", read_bone_map(MAPS / "webxr_hand.yaml"))
    mirrored = _mirrored(SkinnedMesh.read(FOLDER / "hand_left_mesh.npz"))
    with pytest.raises(DataError, match="other side"):
        _fit(mirrored, "hand_left", {})


def _in_millimetres(mesh: SkinnedMesh) -> SkinnedMesh:
    rest = mesh.rest.copy()
    rest[:, :3, 3] *= 1000.0
    return replace(mesh, vertices=1000.0 * mesh.vertices, rest=rest)


def _vertices_in_millimetres(mesh: SkinnedMesh) -> SkinnedMesh:
    return replace(mesh, vertices=1000.0 * mesh.vertices)


def _with_a_far_vertex(mesh: SkinnedMesh) -> SkinnedMesh:
    vertices = mesh.vertices.copy()
    vertices[0] = [0.0, 1e7, 0.0]
    return replace(mesh, vertices=vertices)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (_in_millimetres, "millimetres, multiply all lengths by 0.001"),
        (_vertices_in_millimetres, "one unit"),
        (_with_a_far_vertex, "far from the body"),
    ],
)
def test_other_units_are_refused_with_their_factor(
    change: Callable[[SkinnedMesh], SkinnedMesh], words: str
) -> None:
    mesh = SkinnedMesh.read(FOLDER / "hand_right_mesh.npz")
    with pytest.raises(DataError, match=words):
        _fit(change(mesh), "hand_right", {})


def test_the_case_in_millimetres_is_refused_with_its_factor() -> None:
    mesh = SkinnedMesh.read(CASES / "21-meshes" / "mesh_mm.npz")
    with pytest.raises(DataError, match=r"by 0\.001"):
        _fit(mesh, "hand_right", {})
