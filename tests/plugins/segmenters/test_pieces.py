"""The piece that is kept is the one that was asked for, whole, and followed."""

import numpy as np
import pytest
from scenes import recording

from regkit.interfaces import Expected
from regkit.observation import Frame
from regkit.system.errors import ConfigError, DataError
from regkit.testing.samples import CAMERA
from regkit.testing.scenes import SceneTemplate, WallScene
from regkit_plugins.segmenters.gate import Gate
from regkit_plugins.segmenters.pieces import Pieces
from regkit_plugins.segmenters.pieces.figure import Figure
from regkit_plugins.segmenters.pieces.pieces import held
from regkit_plugins.segmenters.room import Room
from regkit_plugins.templates.composed import Composed

TEMPLATE = SceneTemplate()
WALLED = WallScene("scene", 30.0, 8)
NEAR, FAR = (slice(20, 60), slice(10, 40)), (slice(10, 110), slice(130, 170))


def body_depth(index: int = 4) -> np.ndarray:
    """Returns the image of the body alone."""
    return np.where(WALLED.shown(index), WALLED.shots[index].depth, 0.0)


def scene(index: int = 4) -> np.ndarray:
    """Returns the body at about 2 m, between a near board and a far, larger one."""
    depth = body_depth(index)
    depth[NEAR] = 1.2
    depth[FAR] = 3.4
    return depth


def kept(choose: str | int, depth: np.ndarray, expected: Expected | None = None) -> np.ndarray:
    """Returns the pixels that are kept."""
    frames = recording(depth)
    (frame,) = frames.frames()
    bound = Pieces(choose=choose).bind(frames, TEMPLATE)
    return bound.segmented(frame, expected).depth > 0.0


@pytest.mark.parametrize(
    ("choose", "depths"),
    [("nearest", 1.2), (0, 1.2), ("largest", 3.4), (2, 3.4), ("fits", None), (1, None)],
)
def test_chosen_piece_is_kept_alone(choose, depths):
    depth = scene()
    asked = WALLED.shown(4) if depths is None else depth == depths
    np.testing.assert_array_equal(kept(choose, depth), asked & (depth > 0.0))


def test_pieces_before_the_body_are_unknown_and_those_behind_it_free():
    frames = recording(scene())
    (frame,) = frames.frames()
    left = Pieces().bind(frames, TEMPLATE).segmented(frame, None).depth
    assert np.isnan(left[NEAR]).all()
    assert (left[FAR] == 0.0).all()


def test_moving_piece_is_what_moves_in_the_recording():
    frames = recording(*map(scene, range(8)))
    bound = Pieces(choose="moving").bind(frames, TEMPLATE)
    frame = list(frames.frames())[2]
    seen = bound.segmented(frame, None).depth > 0.0
    np.testing.assert_array_equal(seen, WALLED.shown(2))
    with pytest.raises(DataError, match="do not show what is static"):
        Pieces(choose="moving").bind(recording(scene()), TEMPLATE)


def test_number_beyond_the_pieces_is_refused():
    with pytest.raises(DataError, match=r"there is no piece 3 \(there are 3, numbered from 0\)"):
        kept(3, scene())


def test_nothing_is_kept_where_nothing_fits():
    depth = np.zeros((CAMERA.height, CAMERA.width))
    depth[NEAR] = 0.2
    assert not kept("fits", depth).any()


def test_body_behind_a_bar_stays_whole_and_the_bar_is_unknown():
    depth = scene()
    shown = WALLED.shown(4)
    rows = np.flatnonzero(shown.any(axis=1))
    bar = slice((rows[0] + rows[-1]) // 2 + 4, (rows[0] + rows[-1]) // 2 + 12)
    depth[bar] = 1.5
    seen = kept("fits", depth)
    shown[bar] = False
    assert seen[: bar.start][shown[: bar.start]].all()
    assert seen[bar.stop :][shown[bar.stop :]].all()
    shown[bar] = False
    assert not (seen & ~shown).any()


def test_tracking_follows_the_body_and_not_the_choice():
    expected = Expected(WALLED.body, WALLED.pose(3), WALLED.pose(2))
    np.testing.assert_array_equal(kept("nearest", scene(), expected), WALLED.shown(4))
    lost = Expected(WALLED.body, WALLED.pose(40))
    np.testing.assert_array_equal(kept("nearest", scene(), lost), scene() == 1.2)


def test_pieces_of_a_cloud_are_those_of_the_image():
    depth = scene()
    (image,) = recording(depth).frames()
    cloud = Frame(image.points, place="a cloud")
    bound = Pieces(choose="fits").bind(recording(cloud), TEMPLATE)
    left = bound.segmented(cloud, None)
    assert left.depth is None
    assert len(left.points) == np.count_nonzero(WALLED.shown(4))


def test_template_without_a_surface_has_no_figure():
    class Bare(SceneTemplate):
        def body(self, size):
            body = super().body(size)
            return type(body)(**{**vars(body), "capsules": body.capsules.selected(np.zeros(
                len(body.capsules), dtype=bool))})  # fmt: skip

    with pytest.raises(ConfigError, match="no capsules and no surface"):
        Figure.of(Bare())


def test_gate_keeps_what_the_body_can_reach_once_its_motion_is_known():
    (frame,) = recording(scene()).frames()
    bound = Gate(distance=0.2).bind(recording(frame), TEMPLATE)
    pose, before = WALLED.pose(3), WALLED.pose(2)
    assert bound.segmented(frame, None) is frame
    assert bound.segmented(frame, Expected(WALLED.body, pose)) is frame
    expected = Expected(WALLED.body, pose, before)
    left = bound.segmented(frame, expected)
    capsules = WALLED.body.capsules.place(WALLED.body.place(pose).transforms)
    near = capsules.surface_distance(frame.points) <= 0.3
    np.testing.assert_array_equal(left.points, frame.points[near])
    assert 0 < len(left.points) < len(frame.points)


BOTH = Composed(free={"a": TEMPLATE, "b": TEMPLATE})


def twins(shift: int) -> np.ndarray:
    """Returns the image of the body and of a nearer twin beside it, shifted by pixels."""
    depth, twin = body_depth(), np.roll(body_depth(), shift, axis=1)
    nearer = (twin > 0.0) & ((depth == 0.0) | (twin - 0.2 < depth))
    return np.where(nearer, twin - 0.2, depth)


@pytest.mark.parametrize("choose", ["fits", "largest"])
def test_a_piece_is_kept_for_each_of_several_bodies(choose):
    depth = twins(50)
    shown = depth > 0.0
    board = (slice(20, 60), slice(10, 30))
    depth[board] = 1.2
    frames = recording(depth)
    (frame,) = frames.frames()
    left = Pieces(choose=choose).bind(frames, BOTH).segmented(frame, None).depth > 0.0
    np.testing.assert_array_equal(left, shown)
    alone = Pieces(choose=choose).bind(frames, TEMPLATE).segmented(frame, None).depth > 0.0
    assert np.count_nonzero(alone) < 0.6 * np.count_nonzero(shown)


def test_bodies_that_touch_are_one_piece():
    """What is left then belongs to no body."""
    first, second = Figure.of_each(BOTH)
    assert held(first.area, (first, second)) == 1
    assert held(1.8 * first.area, (first, second)) == 2


def test_several_bodies_alone_in_the_picture_are_no_room():
    frames = recording(twins(50))
    (frame,) = frames.frames()
    assert Room().bind(frames, BOTH).segmented(frame, None) is frame


def in_order(depth: np.ndarray, expected: Expected) -> np.ndarray:
    """Returns the pixels that are kept by pieces, then by the gate, as in a room."""
    frames = recording(depth)
    (frame,) = frames.frames()
    for one in (Pieces(), Gate()):
        frame = one.bind(frames, TEMPLATE).segmented(frame, expected)
    return np.nan_to_num(frame.depth) > 0.0


def test_what_the_body_touches_goes_beyond_the_gate_only():
    depth, shown = body_depth(), WALLED.shown(4)
    rows, columns = np.nonzero(shown)
    row = slice(int(np.median(rows)) - 2, int(np.median(rows)) + 3)
    end = int(columns[rows == row.start].max())
    depth[row, end:] = depth[row.start, end]  # A board that begins at the body, as a bed does.
    expected = Expected(WALLED.body, WALLED.pose(4), WALLED.pose(4))
    left = in_order(depth, expected)
    assert left[shown].mean() > 0.98
    assert 0 < left[~shown].sum() < 0.5 * ((depth > 0.0) & ~shown).sum()


def test_furniture_before_a_hidden_part_is_not_a_fragment_of_the_body():
    depth, shown = body_depth(), WALLED.shown(4)
    rows, _ = np.nonzero(shown)
    desk = int(np.percentile(rows, 70))
    # Its edge is close to the body, and its top comes towards the camera.
    before = 0.06 + np.linspace(0.0, 0.6, len(depth) - desk)
    beside = depth[desk - 1][shown[desk - 1]].min()
    depth[desk:, 20:-20] = beside - before[:, None]
    expected = Expected(WALLED.body, WALLED.pose(4), WALLED.pose(4))
    left = in_order(depth, expected)
    assert left[:desk][shown[:desk]].mean() > 0.98
    assert not left[desk:].any()
