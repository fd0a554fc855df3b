"""Ties: a two-sided body stays its own mirror image, and each step is one of all parameters."""

import numpy as np
import pytest

from regkit.body.freedoms import step_size
from regkit.interfaces import Method
from regkit.skeleton import Placement
from regkit.tuning.ties import tied_steps
from regkit.tuning.tunable import Tunable

BEST = Method.parse("best", place="tests", field="method")


@pytest.fixture(scope="module")
def kite_body(kite_template):
    return kite_template.body(0.6)


def moments(body, listed):
    """Means and covariances of primitives in the rest pose."""
    placed = Placement.of(body.skeleton, body.skeleton.rest()).transforms[listed.segments]
    found = []
    for at, one in zip(placed, listed.parameters, strict=True):
        mean, covariance = one.moments()
        turn = at[:3, :3]
        found.append((turn @ mean + at[:3, 3], turn @ covariance @ turn.T))
    return found


@pytest.mark.parametrize("key", ["gsog", "sog", "sphere"])
def test_body_stays_its_own_mirror_image(kite_body, key, random):
    tunable = Tunable(
        BEST, BEST.tracker, kite_body, key, kite_body.shapes[key], kite_body.shapes[key]
    )
    moved = tunable.primitives(random.normal(size=len(tunable.start())))
    mirror = np.diag([-1.0, 1.0, 1.0])
    found = moments(kite_body, moved)
    for mean, covariance in found:
        gaps = [
            np.abs(mirror @ mean - other).max() + np.abs(mirror @ covariance @ mirror - its).max()
            for other, its in found
        ]
        assert min(gaps) < 1e-9
    before = moments(kite_body, kite_body.shapes[key])
    assert all(
        np.abs(one[0] - other[0]).max() > 1e-4 for one, other in zip(found, before, strict=True)
    )


def test_sides_move_as_one_and_the_middle_keeps_its_symmetry(kite_body):
    listed = kite_body.shapes["gsog"]
    steps = tied_steps(kite_body, listed)
    # An arm has ten parameters. The trunk may move up and to the front, have any extents, turn
    # about the axis through both sides, and have any weight.
    assert steps.shape == (30, 10 + 2 + 3 + 1 + 1)
    assert np.linalg.matrix_rank(steps) == steps.shape[1]


def test_body_without_sides_has_no_ties(kite_body, linkage):
    listed = kite_body.shapes["gsog"]
    steps = tied_steps(linkage, listed)
    assert steps.shape == (30, 30)
    assert np.linalg.matrix_rank(steps) == 30


def test_start_is_the_listed_primitives(human):
    listed = human.shapes["gsog"]
    tunable = Tunable(BEST, BEST.tracker, human, "gsog", listed, listed)
    same = tunable.primitives(tunable.start())
    assert np.array_equal(same.segments, listed.segments)
    for one, other in zip(same.parameters, listed.parameters, strict=True):
        for a, b in zip(one.moments(), other.moments(), strict=True):
            assert np.allclose(a, b, atol=1e-12)
    free = sum(step_size(one.freedoms()) for one in listed.parameters)
    assert len(tunable.start()) < 0.7 * free
