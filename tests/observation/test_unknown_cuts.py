"""Where data end at a wide unknown region, a body may go on; at a narrow one it would be seen."""

import numpy as np
import pytest

from regkit.geometry.camera import Camera
from regkit.observation.unknown_cuts import unknown_cuts
from regkit.search.exemplars.borders import cutting_borders

CAMERA = Camera(width=160, height=120, fx=150.0, fy=140.0, cx=80.0, cy=57.0)
ROWS, COLUMNS = np.mgrid[: CAMERA.height, : CAMERA.width]


def body() -> np.ndarray:
    """Returns the depth image of a body, 40 px wide and 90 px high."""
    depth = np.zeros(ROWS.shape)
    depth[15:105, 60:100] = 2.0
    return depth


def cuts(depth: np.ndarray) -> list[tuple[int, np.ndarray]]:
    return unknown_cuts(CAMERA, depth, CAMERA.back_projected(depth))


@pytest.mark.parametrize("slope", [0.0, 0.4, -0.4])
@pytest.mark.parametrize("turns", range(4))
def test_region_on_any_side_cuts_along_its_edge(slope, turns):
    depth = body()
    inside = [ROWS, COLUMNS, 119 - ROWS, 159 - COLUMNS][turns]
    along, level = (COLUMNS - 80, 80) if turns % 2 == 0 else (ROWS - 60, 85)
    edge = level + slope * along
    depth[inside >= edge] = np.nan
    ((length, normal),) = cuts(depth)
    assert 24 <= length <= 90
    signed = CAMERA.rays() @ normal
    # Rays are beyond the plane exactly where the picture is unknown, to a pixel at its edge.
    clear = np.abs(inside - edge) > 1.5
    np.testing.assert_array_equal((signed > 0.0)[clear], np.isnan(depth)[clear])


def test_shadow_beside_a_body_does_not_cut_it():
    depth = body()
    depth[15:105, 100:112] = np.nan
    assert cuts(depth) == []
    depth[15:105, 100:130] = np.nan
    assert len(cuts(depth)) == 1


def test_margin_of_a_picture_cuts_as_its_border():
    depth = body()
    depth[85:] = 0.0
    depth[-4:] = np.nan
    assert cuts(depth) == []
    depth[85:116, 60:100] = 2.0
    ((_, normal),) = cuts(depth)
    whole = np.where(np.isnan(depth), 2.0 * (depth[80] > 0.0), depth)
    (border,) = cutting_borders(CAMERA, whole, CAMERA.back_projected(whole))
    # The margin is 4 px, less than 2 degrees.
    assert normal @ border > np.cos(np.radians(2.0))


def test_picture_without_unknown_pixels_has_its_borders_only():
    depth = body()
    assert cuts(depth) == []
    depth[105:, 60:100] = 2.0
    assert len(cutting_borders(CAMERA, depth, CAMERA.back_projected(depth))) == 1
