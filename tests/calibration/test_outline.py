"""Outlines in depth images: where they are, and how far a skin's rim is from them."""

import numpy as np
import pytest

from regkit.body.linear_shape import LinearShape
from regkit.calibration.skin.outline import Outline
from regkit.calibration.skin.posed_skin import PosedSkin
from regkit.calibration.skin.skin_points import SkinPoints
from regkit.geometry.camera import Camera
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.sensors.raycast import ray_cast
from regkit_plugins.templates.hand import Hand

CAMERA = Camera(width=160, height=120, fx=180.0, fy=180.0, cx=79.5, cy=59.5)
AWAY = 0.35
PIXEL = AWAY / CAMERA.fx


@pytest.fixture(scope="module")
def hand() -> LinearShape:
    return LinearShape.of(Hand().description())


def placed(hand: LinearShape, scale: float = 1.0) -> np.ndarray:
    """Vertices of the open hand before the camera, scaled about its middle."""
    root = rigid(vector_to_matrix(np.array([0.4, 0.3, 0.2])), np.array([0.0, 0.0, AWAY]))
    pose = hand.skeleton(hand.mean).rest(root)
    vertices = PosedSkin.of(hand, hand.mean, pose).vertices
    middle = vertices.mean(axis=0)
    return scale * (vertices - middle) + [0.0, 0.0, AWAY]


def distances(hand: LinearShape, outline: Outline, vertices: np.ndarray):
    skin = SkinPoints.on(hand.mesh.faces)
    return outline.distances(skin, skin.place(vertices), skin.normals(vertices), 0.19)


def test_rim_of_the_same_skin_is_within_a_pixel(hand):
    vertices = placed(hand)
    outline = Outline.of(CAMERA, ray_cast(vertices, hand.mesh.faces, CAMERA), 10_000)
    found = distances(hand, outline, vertices)
    assert found.lost < 0.05 * len(outline.pixels)
    assert np.median(np.abs(found.lengths)) < 0.5 * PIXEL
    assert abs(np.median(found.lengths)) < 0.2 * PIXEL


@pytest.mark.parametrize("scale", [0.95, 1.05])
def test_distance_has_the_sign_of_the_missing_breadth(hand, scale):
    vertices = placed(hand)
    outline = Outline.of(CAMERA, ray_cast(vertices, hand.mesh.faces, CAMERA), 10_000)
    found = distances(hand, outline, placed(hand, scale))
    assert np.sign(np.median(found.lengths)) == np.sign(1.0 - scale)


def test_border_unknown_and_missing_pixels_are_no_outline():
    depth = np.full((120, 160), 1.0)
    depth[30, 40] = 0.0
    depth[60:80, 90:110] = np.nan
    assert not len(Outline.of(CAMERA, depth, 100).pixels)
    depth[:, :50] = 0.0
    found = Outline.of(CAMERA, depth, 1000)
    assert set(found.pixels[:, 0].round(1)) == {49.5}
    np.testing.assert_allclose(found.directions, np.tile([-1.0, 0.0], (len(found.pixels), 1)))
    assert len(Outline.of(CAMERA, depth, 50).pixels) == 50


def test_nothing_in_the_picture_meets_no_rim(hand):
    outline = Outline.of(CAMERA, np.zeros((120, 160)), 100)
    found = distances(hand, outline, placed(hand))
    assert len(found) == 0
