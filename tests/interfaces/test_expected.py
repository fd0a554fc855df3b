"""Where a body may be, from its last poses."""

from __future__ import annotations

import numpy as np

from regkit.interfaces import Expected
from regkit.skeleton import PoseDescription
from regkit_plugins.templates.human import Human

BODY = Human(height=1.7).body(1.7)
REACH = 0.1


def around(name: str, away: float) -> np.ndarray:
    """Returns points (N, 3) so far from a body at rest, beside one of its segments."""
    placed = BODY.capsules.place(BODY.place(BODY.skeleton.rest()).transforms)
    own = placed.selected(placed.segments == BODY.skeleton.names.index(name))
    ways = np.random.default_rng(0).normal(size=(2000, 3))
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    points = own.ends.mean(axis=(0, 1)) + (own.radii.mean() + away) * ways
    return points[np.abs(placed.surface_distance(points) - away) < 0.3 * REACH]


def test_a_part_that_jumped_reaches_farther_and_the_others_do_not():
    pose, rest = BODY.skeleton.pose(PoseDescription(joints={"left_shin": 80})), BODY.skeleton.rest()
    expected = Expected(BODY, rest, pose)
    shin, head = around("left_shin", 2.0 * REACH), around("head", 2.0 * REACH)
    assert min(len(shin), len(head)) > 20
    assert expected.within(shin, REACH).all()
    assert not expected.within(head, REACH).any()
    assert not Expected(BODY, rest).within(shin, REACH).any()


def test_a_body_that_moved_as_a_whole_reaches_as_far_on_all_sides():
    rest = BODY.skeleton.rest()
    step = np.zeros(BODY.skeleton.dofs)
    step[2] = 1.5 * REACH
    expected = Expected(BODY, rest, BODY.skeleton.retract(rest, step))
    for name in ("head", "left_shin", "right_hand"):
        assert expected.within(around(name, 2.0 * REACH), REACH).all()
        assert not expected.within(around(name, 3.0 * REACH), REACH).any()


def test_what_jumped_was_corrected_and_reaches_no_farther():
    rest = BODY.skeleton.rest()
    step = np.zeros(BODY.skeleton.dofs)
    step[0] = 1.0
    points = np.concatenate(
        [around(name, away) for name in ("head", "left_shin") for away in (0.05, 0.2)]
    )
    jumped = Expected(BODY, rest, BODY.skeleton.retract(rest, step)).within(points, REACH)
    np.testing.assert_array_equal(jumped, Expected(BODY, rest).within(points, REACH))
    assert 0 < jumped.sum() < len(points)
