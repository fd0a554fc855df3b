"""A pixel without a measurement is unknown among measured ones, and free in the open."""

import numpy as np
import pytest
from scenes import frame_of, recording

from regkit.system.notes import RegkitWarning
from regkit.testing.samples import CAMERA
from regkit.testing.scenes import WALL, SceneTemplate, WallScene
from regkit_plugins.segmenters.room import Room
from regkit_plugins.segmenters.unmeasured import Surroundings

SHAPE = (CAMERA.height, CAMERA.width)
SHADOW = slice(30, 110), slice(100, 112)


def unmeasured(depth: np.ndarray) -> np.ndarray:
    frame = frame_of(depth)
    left = Surroundings().segmented(frame, None)
    np.testing.assert_array_equal(left.points, frame.points)
    assert len(left.pixels) == len(left.points)
    return np.isnan(left.depth)


def test_shadow_and_margin_in_a_room_are_unknown():
    depth = np.full(SHAPE, 3.0)
    depth[SHADOW] = depth[:, :6] = depth[-3:] = 0.0
    np.testing.assert_array_equal(unmeasured(depth), depth == 0.0)


def test_noise_of_outlines_stays_free():
    depth = np.full(SHAPE, 3.0)
    depth[30:110, 80:82] = depth[50, 20:60] = 0.0
    assert not unmeasured(depth).any()


def test_sky_and_what_surrounds_a_body_alone_are_free():
    depth = np.zeros(SHAPE)
    depth[80:] = 3.0
    assert not unmeasured(depth)[:78].any()
    depth = np.zeros(SHAPE)
    depth[30:110, 80:100] = 2.0
    assert not unmeasured(depth).any()


def test_shadow_of_a_body_in_a_room_is_unknown_and_the_wall_free():
    walled = WallScene("scene", 30.0, 1)
    (frame,) = walled.frames()
    shown = walled.shown(0)
    shadow = np.roll(shown, 8, axis=1) & ~shown
    depth = np.where(shadow, 0.0, frame.depth)
    with pytest.warns(RegkitWarning, match="took the body out"):
        bound = Room().bind(recording(depth), SceneTemplate())
    left = bound.segmented(frame_of(depth), None).depth
    assert not np.isnan(left[~shadow]).any()
    # The ends of the shadow are narrow.
    assert np.isnan(left[shadow]).mean() > 0.9
    assert (left[(frame.depth == WALL) & ~shadow] == 0.0).all()
    np.testing.assert_array_equal(left > 0.0, shown)
