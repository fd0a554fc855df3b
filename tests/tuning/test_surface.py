"""What a camera sees of a body: closed meshes that lie on the capsules."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from regkit.geometry.capsules import Capsules
from regkit.tuning.samples.holes import closed, opening
from regkit.tuning.samples.surface import capsule_surface, rendered_surface

SHAPES = {
    "cylinder": ([[0, 0, 0], [0.1, 0.4, 0]], [0.1, 0.1]),
    "tapered": ([[0, 0, 0], [0, 0.4, 0.2]], [0.15, 0.05]),
    "widening": ([[0, 0, 0], [0, 0, -0.3]], [0.05, 0.2]),
    "sphere": ([[0.1, 0, 0], [0.1, 0, 0]], [0.1, 0.1]),
    "swallowed": ([[0, 0, 0], [0.02, 0, 0]], [0.1, 0.03]),
}


def edges_of(faces):
    return Counter(
        (int(face[corner - 1]), int(face[corner])) for face in faces for corner in range(3)
    )


def volume(vertices, faces):
    a, b, c = np.moveaxis(vertices[faces], 1, 0)
    return (a * np.cross(b, c)).sum() / 6.0


def to_envelope(points, capsules):
    """Distances of points to the envelope of many spheres on one axis."""
    samples = capsules.axis_samples(3001)
    apart = np.linalg.norm(points[:, None] - samples.points, axis=2)
    return (apart - samples.radii).min(axis=1)


def of_shape(shape):
    ends, radii = SHAPES[shape]
    return Capsules(np.zeros(1, dtype=int), np.array([ends], dtype=float), np.array([radii]))


@pytest.mark.parametrize("shape", SHAPES)
def test_capsule_mesh_is_closed_and_faces_outwards(shape):
    surface = capsule_surface(of_shape(shape))
    edges = edges_of(surface.faces)
    assert set(edges.values()) == {1}
    assert all(edge[::-1] in edges for edge in edges)
    vertices = surface.place(np.eye(4)[None])
    assert len(vertices) - len(edges) // 2 + len(surface.faces) == 2
    assert volume(vertices, surface.faces) > 0.0


@pytest.mark.parametrize("shape", SHAPES)
def test_capsule_mesh_lies_on_its_capsule(shape):
    capsules = of_shape(shape)
    surface = capsule_surface(capsules)
    vertices = surface.place(np.eye(4)[None])
    assert np.abs(to_envelope(vertices, capsules)).max() < 1e-7
    middles = vertices[surface.faces].mean(axis=1)
    distances = to_envelope(middles, capsules)
    assert distances.max() < 1e-9
    assert distances.min() > -0.05 * capsules.radii.max()


def test_capsule_meshes_move_with_their_segments(human):
    bare = replace(human, surface=None)
    surface = rendered_surface(bare)
    stance = human.stances[-1].pose
    transforms = human.place(stance).transforms
    placed = human.capsules.place(transforms)
    distances = placed.surface_distance(surface.place(transforms))
    # Vertices within another capsule are beneath the surface of the union.
    assert distances.max() < 1e-9
    assert (np.abs(distances) < 1e-9).mean() > 0.3


def test_mesh_of_a_hand_is_closed_at_the_wrist(hand):
    assert opening(hand) @ [0.0, -1.0, 0.0] > 0.9
    faces = rendered_surface(hand).faces
    edges = edges_of(faces)
    # A decimated mesh has an edge or two with more than two triangles.
    assert sum(edge[::-1] not in edges for edge in edges) <= 2
    assert np.array_equal(faces[: len(hand.surface.faces)], hand.surface.faces)
    whole = replace(hand, surface=replace(hand.surface, faces=faces))
    assert opening(whole) is None


def test_small_holes_are_no_opening(human):
    assert opening(human) is None
    assert opening(replace(human, surface=None)) is None


def test_closed_mesh_stays_as_it_is():
    tetrahedron = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])
    assert np.array_equal(closed(tetrahedron), tetrahedron)
    assert volume(np.eye(4)[:, :3], closed(tetrahedron[:3])) == pytest.approx(
        volume(np.eye(4)[:, :3], tetrahedron)
    )
