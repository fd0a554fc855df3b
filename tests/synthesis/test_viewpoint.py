"""A camera looks from any side, and its roll turns the image."""

from __future__ import annotations

import numpy as np
import pytest
from pydantic import ValidationError

from regkit.geometry.camera import Camera
from regkit.geometry.rigid import transformed
from regkit.sensors import Sensor
from regkit_synthesis.recordings.take import Take
from regkit_synthesis.viewpoint import Viewpoint

SQUARE = Camera(width=80, height=80, fx=100.0, fy=100.0, cx=39.5, cy=39.5)
WIDE = Camera(width=176, height=144, fx=231.0, fy=220.0, cx=90.0, cy=70.0)
POINTS = np.random.default_rng(0).normal(size=(300, 3)) * [0.2, 0.3, 0.9] + [0.4, 1.0, 0.8]


def walk(**view):
    motion = {"kind": "clip", "name": "walk", "grounded": False}
    take = Take.model_validate({"motion": motion, "frames": 1, "view": view})
    return take.scene("walk", Sensor(SQUARE, 0.0, 1000.0), 30.0, 1)


@pytest.mark.parametrize("view", [{"heading_deg": 15.0}, {"place": (0.05, 0.9, 3.0)}])
def test_quarter_roll_turns_image_and_truth_counter_clockwise(view):
    level, rolled = walk(**view), walk(**view, roll_deg=90.0)
    upright, turned = (next(scene.views()).depth for scene in (level, rolled))
    expected = np.rot90(upright)
    both = (expected > 0.0) & (turned > 0.0)
    # Rays that graze the outline may miss it after rounding.
    assert both.sum() > 0.99 * max((expected > 0.0).sum(), (turned > 0.0).sum())
    assert np.median(np.abs(expected - turned)[both]) < 1e-6
    x, y, z = np.moveaxis(level.truth(), -1, 0)
    assert np.allclose(rolled.truth(), np.stack([y, -x, z], axis=-1), atol=1e-9)


@pytest.mark.parametrize("elevation", [-90.0, -40.0, 0.0, 60.0, 90.0])
def test_whole_region_is_in_the_image_from_every_side(elevation):
    for heading in (0.0, 75.0, 180.0):
        for roll in (0.0, 37.0, 90.0, 180.0, -60.0):
            view = Viewpoint(heading_deg=heading, elevation_deg=elevation, roll_deg=roll)
            points = transformed(view.placed(WIDE, lambda: POINTS), POINTS)
            pixels = WIDE.projected(points)
            assert points[:, 2].min() > 0.0
            assert pixels.min() > 0.0
            assert (pixels.max(axis=0) < [WIDE.width - 1, WIDE.height - 1]).all()


def test_camera_from_straight_above_looks_down():
    T = Viewpoint(elevation_deg=90.0, roll_deg=0.0, distance=3.0).placed(WIDE, lambda: POINTS)
    assert np.allclose(T[2, :3], [0.0, 0.0, -1.0])
    with pytest.raises(ValidationError, match="less than or equal to 90"):
        Viewpoint(elevation_deg=91.0)
