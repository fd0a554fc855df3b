"""How well data support each segment: those that have data of their own on them."""

from dataclasses import replace

import numpy as np

from regkit.body.support import WEAK, segment_supports
from regkit.geometry.capsules import Capsules
from regkit_plugins.templates.human import Human

BODY = Human(height=1.7).body(1.7)
NAMES = BODY.skeleton.names
REST = BODY.place(BODY.skeleton.rest()).transforms


def on_surface(segments: list[str], random: np.random.Generator) -> np.ndarray:
    """Points all over the capsules of some segments, in the rest pose."""
    chosen = np.isin(BODY.capsules.segments, [NAMES.index(name) for name in segments])
    axes = BODY.capsules.selected(chosen).axis_samples(30)
    around = random.normal(size=(8, *axes.points.shape))
    around /= np.linalg.norm(around, axis=2, keepdims=True)
    points = axes.place(REST) + axes.radii[:, None] * around
    return points.reshape(-1, 3)


def test_segments_with_data_on_them_are_supported_and_others_are_not(random):
    seen = [name for name in NAMES if not name.startswith("left_")]
    supports = dict(zip(NAMES, segment_supports(BODY, REST, on_surface(seen, random)), strict=True))
    assert min(supports[name] for name in seen) > 0.6
    for name in ("left_forearm", "left_hand", "left_shin", "left_foot"):
        assert supports[name] < WEAK


def test_support_is_the_share_of_a_segment_that_is_seen(random):
    points = on_surface(["left_shin"], random)
    at = NAMES.index("left_shin")
    low, high = points[:, 1].min(), points[:, 1].max()
    half = points[points[:, 1] > 0.5 * (low + high)]
    assert 0.3 < segment_supports(BODY, REST, half)[at] < 0.75


def test_limb_inside_another_has_no_data_of_its_own(random):
    points = on_surface(
        [name for name in NAMES if "arm" not in name and "hand" not in name], random
    )
    stuck = REST.copy()
    trunk = stuck[NAMES.index("chest"), :3, 3]
    for name in ("left_forearm", "left_hand"):
        stuck[NAMES.index(name), :3, 3] = trunk
    supports = segment_supports(BODY, stuck, points)
    assert supports[NAMES.index("left_hand")] < WEAK


def test_support_moves_with_body_and_data(random):
    points = on_surface(list(NAMES), random)
    before = segment_supports(BODY, REST, points)
    shift = np.array([0.3, -0.2, 2.0])
    moved = REST.copy()
    moved[:, :3, 3] += shift
    np.testing.assert_allclose(segment_supports(BODY, moved, points + shift), before, atol=0.1)
    assert (segment_supports(BODY, REST, points + 5.0) == 0.0).all()


def test_body_without_capsules_has_unknown_support():
    nothing = Capsules(np.zeros(0, dtype=np.intp), np.zeros((0, 2, 3)), np.zeros((0, 2)))
    supports = segment_supports(replace(BODY, capsules=nothing), REST, np.zeros((5, 3)))
    assert np.isnan(supports).all()
