"""Lens distortion: what a lens shows is taken out of its depth images."""

import json

import numpy as np
import pytest

from regkit.geometry.camera import Camera
from regkit.geometry.distortion import BrownConrady, KannalaBrandt, distortion_of
from regkit.geometry.lens import Lens
from regkit.system.errors import DataError
from regkit.system.notes import RegkitWarning

CAMERA = Camera(160, 120, 110.0, 112.0, 81.3, 58.9)
LENSES = {
    "barrel": BrownConrady((-0.3, 0.1, 0.001, -0.002, -0.01)),
    "pincushion": BrownConrady((0.15, 0.02, -0.001, 0.001)),
    "rational": BrownConrady((0.4, -2.6, 3e-4, -1e-4, 1.5, 0.3, -2.4, 1.4)),
    "fisheye": KannalaBrandt((0.02, -0.01, 0.003, -0.001)),
}


def shown(distortion, directions):
    """Returns where a lens shows directions, by the formulas of the models' papers."""
    x, y = directions[..., 0], directions[..., 1]
    square = x**2 + y**2
    if isinstance(distortion, KannalaBrandt):
        angle = np.arctan(np.sqrt(square))
        powers = sum(k * angle ** (2 * n) for n, k in enumerate(distortion.coefficients, 1))
        factor = angle * (1 + powers) / np.maximum(np.sqrt(square), 1e-12)
        return np.stack([x * factor, y * factor], axis=-1)
    k1, k2, p1, p2, k3, k4, k5, k6 = [*distortion.coefficients, *[0.0] * 4][:8]
    radial = (1 + k1 * square + k2 * square**2 + k3 * square**3) / (
        1 + k4 * square + k5 * square**2 + k6 * square**3
    )
    return np.stack(
        [
            x * radial + 2 * p1 * x * y + p2 * (square + 2 * x**2),
            y * radial + p1 * (square + 2 * y**2) + 2 * p2 * x * y,
        ],
        axis=-1,
    )


def undistorted(distortion, directions):
    """Returns the directions that a lens shows in given directions, by fixed-point iteration."""
    found = directions.copy()
    for _ in range(200):
        found = found + 0.7 * (directions - shown(distortion, found))
    return found


def measured(distortion, depth_of):
    """Returns the image that a lens measures, of a depth as a function of the direction."""
    directions = undistorted(distortion, CAMERA.rays()[..., :2])
    assert np.abs(shown(distortion, directions) - CAMERA.rays()[..., :2]).max() < 1e-9
    return depth_of(directions)


@pytest.mark.parametrize("name", LENSES)
def test_directions_are_distorted_as_the_models_say(name, random):
    directions = random.uniform(-0.7, 0.7, size=(500, 2))
    distorted = LENSES[name].distorted(directions)
    kept = np.isfinite(distorted).all(axis=1)
    assert kept.mean() > 0.9
    np.testing.assert_allclose(
        distorted[kept], shown(LENSES[name], directions)[kept], rtol=0, atol=1e-12
    )


@pytest.mark.parametrize("name", LENSES)
def test_plane_through_a_lens_comes_back_as_a_plane(name):
    normal, offset = np.array([0.3, -0.2, 1.0]), 2.0
    image = measured(LENSES[name], lambda at: offset / (at @ normal[:2] + normal[2]))
    lens = Lens(CAMERA, LENSES[name])
    rectified = lens.rectified(image)
    points = CAMERA.back_projected(rectified)
    assert len(points) > 0.6 * rectified.size
    # A pixel is at most half a pixel off, and the plane is inclined.
    steepness = np.hypot(*normal[:2]) * rectified.max() ** 2 / offset
    assert np.abs(points @ normal - offset).max() < 1.5 * steepness / CAMERA.fx
    raw = np.abs(CAMERA.back_projected(image) @ normal - offset).max()
    assert raw > 2.0 * np.abs(points @ normal - offset).max()


@pytest.mark.parametrize("name", LENSES)
def test_points_through_a_lens_come_back_within_a_pixel(name):
    """The pixel that the rectified image takes a depth from shows the same direction."""
    lens = Lens(CAMERA, LENSES[name])
    rows, columns = np.divmod(lens.sources, CAMERA.width)
    seen = np.stack([(columns - CAMERA.cx) / CAMERA.fx, (rows - CAMERA.cy) / CAMERA.fy], axis=-1)
    off = (undistorted(LENSES[name], seen) - CAMERA.rays()[..., :2]) * [CAMERA.fx, CAMERA.fy]
    inside = lens.sources >= 0
    assert inside.mean() > 0.6
    assert np.abs(off[inside]).max() < 1.0


def test_depth_is_taken_and_never_interpolated(random):
    image = np.where(random.uniform(size=(120, 160)) < 0.5, 1.0, 3.0)
    image[40:60] = 0.0
    rectified = Lens(CAMERA, LENSES["barrel"]).rectified(image)
    assert set(np.unique(rectified)) == {0.0, 1.0, 3.0}


def test_image_without_distortion_stays_as_it_is(random):
    image = random.uniform(1.0, 2.0, size=(120, 160))
    for none in (None, BrownConrady((0.0,) * 5)):
        assert Lens(CAMERA, none).rectified(image) is image


def test_direction_beyond_the_turn_of_a_polynomial_is_not_shown():
    """With k1 = -0.3 the shown radius falls again beyond 1/sqrt(0.9) = 1.054."""
    distorted = BrownConrady((-0.3, 0.0, 0.0, 0.0)).distorted(np.array([[1.0, 0.0], [1.5, 0.0]]))
    assert np.isfinite(distorted[0]).all()
    assert np.isnan(distorted[1]).all()


def camera_file(folder, **changed):
    path = folder / "camera.json"
    path.write_text(json.dumps({**json.loads(CAMERA.to_json()), **changed}))
    return path


def test_distortion_is_read_from_the_cameras_file(tmp_path):
    path = camera_file(
        tmp_path, distortion={"model": "brown_conrady", "coefficients": [0.1, 0, 0, 0, 0]}
    )
    assert Lens.read(path) == Lens(CAMERA, BrownConrady((0.1, 0.0, 0.0, 0.0, 0.0)))
    with pytest.warns(RegkitWarning, match="distortion"):
        assert Camera.read(path) == CAMERA
    assert Lens.read(camera_file(tmp_path)) == Lens(CAMERA)


@pytest.mark.parametrize(
    ("content", "word"),
    [
        ({"model": "brown", "coefficients": [0, 0, 0, 0]}, "brown"),
        ({"model": 3, "coefficients": [0, 0, 0, 0]}, "3"),
        ({"model": "kannala_brandt", "coefficients": [0, 0, 0, 0, 0]}, "5"),
        ({"model": "kannala_brandt", "coefficients": [0, 0, 0, True]}, "True"),
        ({"model": "kannala_brandt", "coefficients": "0000"}, "0000"),
        ({"model": "brown_conrady", "coefficients": [1e300, 0, 0, 0]}, "1e+300"),
        ({"model": "brown_conrady"}, "coefficients"),
        ([0.1, 0, 0, 0], "model"),
    ],
)
def test_distortion_that_is_none_is_refused(content, word):
    with pytest.raises(DataError) as caught:
        distortion_of(content)
    assert word in caught.value.message
