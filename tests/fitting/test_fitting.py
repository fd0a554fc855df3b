"""Fitting templates: points inside a mesh, moments, clusters, capsules, YAML."""

from pathlib import Path

import numpy as np
import pytest

from regkit.body import BodyDescription
from regkit.config.document import Document
from regkit.fitting.flesh import Flesh, closed, interior_points
from regkit.geometry.rotation import vector_to_matrix
from regkit.interfaces import ShapeModel
from regkit_plugins.templates import FOLDER
from regkit_synthesis.templates.__main__ import templates
from regkit_synthesis.templates.capsules import Piece, fitted
from regkit_synthesis.templates.gaussians import balls, gaussian, symmetric_balls
from regkit_synthesis.templates.texts import human_text

CUBE = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
FACES = np.array(
    [
        [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
        [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3],
    ]
)  # fmt: skip


def grid(spacing: float) -> np.ndarray:
    axis = np.arange(-1.0 + spacing / 2, 1.0, spacing)
    return np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)


def test_interior_points_fill_the_volume() -> None:
    assert len(interior_points(CUBE, FACES, 0.1)) * 0.1**3 == pytest.approx(8.0, rel=0.01)


def test_interior_points_of_an_open_mesh_are_those_of_the_closed_one() -> None:
    np.testing.assert_array_equal(
        interior_points(CUBE, FACES[:-2], 0.2), interior_points(CUBE, FACES, 0.2)
    )


def test_interior_points_of_a_mesh_with_several_holes_are_those_of_the_closed_one() -> None:
    # A tube: the sides x = -1 and x = 1 of the cube are missing.
    np.testing.assert_array_equal(
        interior_points(CUBE, FACES[4:], 0.2), interior_points(CUBE, FACES, 0.2)
    )


def test_closed_leaves_a_watertight_mesh_alone() -> None:
    assert len(closed(CUBE, FACES)[1]) == len(FACES)
    assert len(closed(CUBE, FACES[:-2])[1]) == len(FACES) + 2


def test_gaussian_has_the_moments_of_a_turned_box() -> None:
    turn = vector_to_matrix(np.radians([10.0, -20.0, 15.0]))
    points = grid(0.05) * [0.3, 0.1, 0.2] @ turn.T + [0.1, 0.2, 0.3]
    found = gaussian(points)
    np.testing.assert_allclose(found.centre, [0.1, 0.2, 0.3], atol=1e-4)
    np.testing.assert_allclose(found.sigma, np.array([0.3, 0.1, 0.2]) / np.sqrt(3.0), atol=2e-4)
    np.testing.assert_allclose(found.rotation_deg, [10.0, -20.0, 15.0], atol=0.1)


def test_balls_split_a_rod_along_its_length() -> None:
    found = balls(grid(0.1) * [0.05, 0.4, 0.05], 4)
    heights = sorted(ball.centre[1] for ball in found)
    np.testing.assert_allclose(heights, [-0.3, -0.1, 0.1, 0.3], atol=0.05)


def test_symmetric_balls_are_their_own_mirror_image() -> None:
    found = symmetric_balls(grid(0.1) * [0.4, 0.3, 0.1], pairs=2, middle=1)
    centres = np.array([ball.centre for ball in found])
    assert len(found) == 5
    np.testing.assert_allclose(centres[0::2][:2] * [-1.0, 1.0, 1.0], centres[1::2], atol=1e-9)
    assert centres[4, 0] == 0.0


def test_fitted_capsule_finds_a_capsule() -> None:
    random = np.random.default_rng(1)
    directions = random.standard_normal((4000, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    surface = 0.05 * directions
    surface[:, 1] += np.where(directions[:, 1] > 0.0, 0.3, 0.0)
    sides = random.uniform(0.0, 0.3, 4000)
    around = directions * [1.0, 0.0, 1.0]
    around *= 0.05 / np.linalg.norm(around, axis=1, keepdims=True)
    surface = np.concatenate([surface, around + sides[:, None] * [0.0, 1.0, 0.0]])
    flesh = Flesh(surface, surface, np.ones(len(surface)))
    (found,) = fitted((Piece((0.01, 0.05, 0.0), (0.0, 0.25, 0.02), 0.03),), flesh, scale=0.01)
    np.testing.assert_allclose(found.start, [0.0, 0.0, 0.0], atol=2e-3)
    np.testing.assert_allclose(found.end, [0.0, 0.3, 0.0], atol=2e-3)
    np.testing.assert_allclose(found.radius, [0.05, 0.05], atol=1e-3)


def test_human_text_reads_back_as_the_same_template(tmp_path: Path) -> None:
    body = Document.read(FOLDER / "human.yaml").validated(BodyDescription)
    path = tmp_path / "again.yaml"
    path.write_text(human_text(body))
    shipped = (FOLDER / "human.yaml").read_text()
    assert path.read_text() == shipped.partition("\n")[2]  # Without the line for editors.
    again = Document.read(path).validated(BodyDescription)
    assert again.mesh == tmp_path / "human_mesh.npz"
    assert again.modes == tmp_path / "human_modes.npz"
    assert again.model_copy(update={"mesh": body.mesh, "modes": body.modes}) == body


@pytest.mark.long
def test_templates_can_be_made_again(tmp_path: Path) -> None:
    """What is made is what is shipped, but for the last digits on another processor."""
    for name, template in templates().items():
        template.write(tmp_path / name)
        made, shipped = (
            Document.read(folder / name).validated(BodyDescription) for folder in (tmp_path, FOLDER)
        )
        for kind in ("sog", "gsog"):
            shape = ShapeModel.load(kind)()
            own, other = (shape.bind(body.body(name, 1.0)) for body in (made, shipped))
            np.testing.assert_array_equal(own.segments, other.segments)
            np.testing.assert_allclose(own.centres, other.centres, atol=1e-3)
            np.testing.assert_allclose(own.scales, other.scales, atol=1e-3)
        own, other = (body.body(name, 1.0).surface for body in (made, shipped))
        np.testing.assert_array_equal(own.faces, other.faces)
        np.testing.assert_allclose(own.points, other.points, atol=1e-5)
