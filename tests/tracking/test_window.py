"""Windows: quantiles of the last values, which grow no further and change nothing before."""

import numpy as np
import pytest

from regkit.interfaces.window import WINDOW, Window


@pytest.mark.parametrize("count", [1, 2, 7, WINDOW, WINDOW + 1, 2 * WINDOW + 3])
def test_quantiles_are_those_of_the_last_values(random, count):
    # Few distinct values, so that many are equal.
    values = random.integers(0, 200, size=count) / 200.0
    window = Window()
    for value in values:
        window = window.followed_by(value)
    last = values[-WINDOW:]
    assert len(window) == len(last)
    for share in (0.0, 0.1, 0.25, 0.75, 1.0):
        assert window.quantile(share) == pytest.approx(np.quantile(last, share), abs=1e-12)


def test_unknown_values_are_left_out():
    window = Window().followed_by(np.nan)
    assert np.isnan(window.quantile(0.5))
    window = window.followed_by(0.4).followed_by(np.nan)
    assert window.quantile(0.5) == 0.4


def test_window_is_a_value(random):
    window = Window()
    for value in random.uniform(size=WINDOW):
        window = window.followed_by(value)
    before = window.quantile(0.3), tuple(window.latest)
    window.followed_by(0.0).followed_by(1.0)
    assert (window.quantile(0.3), tuple(window.latest)) == before
    assert window.followed_by(0.5) == window.followed_by(0.5)
