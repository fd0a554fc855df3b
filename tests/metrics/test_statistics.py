"""Summaries over recordings and tests between methods."""

import numpy as np
import pytest
from scipy.stats import wilcoxon

from regkit.metrics import METRICS, Measure, compared, summary
from regkit.metrics.statistics import MIN_SAMPLES, bootstrapped, holm, signed_rank

FIGURE = "joint_error_raw_cm"


def measures(**values: list[float | None]) -> dict[str, dict[str, Measure]]:
    """Methods whose joint errors on recordings s0, s1, ... are given; None is not finished."""
    nothing = dict.fromkeys(METRICS)
    return {
        method: {
            f"s{index}": Measure(**(nothing | {FIGURE: value}))
            for index, value in enumerate(errors)
            if value is not None
        }
        for method, errors in values.items()
    }


def test_summary_is_of_what_is_known():
    found = summary([1.0, None, 3.0, 8.0])
    assert (found.n, found.mean, found.median) == (3, 4.0, 3.0)
    nothing = summary([None])
    assert (nothing.n, nothing.mean, nothing.median, nothing.interval) == (0, None, None, None)


@pytest.mark.parametrize("statistic", ["mean", "median"])
def test_few_values_have_no_interval(random, statistic):
    values = random.normal(size=MIN_SAMPLES)
    assert bootstrapped(values[:-1], statistic) is None
    low, high = bootstrapped(values, statistic)
    assert low < getattr(np, statistic)(values) < high


def test_interval_is_the_same_every_time(random):
    values = random.normal(size=20)
    assert bootstrapped(values, "mean") == bootstrapped(values, "mean")


def test_interval_moves_and_grows_with_the_values(random):
    values = random.normal(size=20)
    low, high = bootstrapped(values, "mean")
    assert bootstrapped(3.0 * values + 5.0, "mean") == pytest.approx(
        (3.0 * low + 5, 3.0 * high + 5)
    )


def test_identical_values_have_an_interval_of_no_width():
    assert bootstrapped(np.full(9, 2.5), "mean") == (2.5, 2.5)


@pytest.mark.parametrize("statistic", ["mean", "median"])
def test_values_that_only_rounding_tells_apart_are_identical(statistic):
    values = np.array([100.0] * 5 + [np.nextafter(100.0, 0.0)])
    assert bootstrapped(values, statistic) == (values[-1], 100.0)


def test_interval_of_the_mean_covers_it_as_often_as_it_says(random):
    """Of 200 samples of 28 skewed values, 95 % should; a few less is what so few values allow."""
    intervals = [bootstrapped(random.gamma(3.0, size=28), "mean") for _ in range(200)]
    covered = np.mean([low < 3.0 < high for low, high in intervals])
    assert 0.88 < covered < 0.99


def test_signed_rank_is_wilcoxons(random):
    differences = random.normal(loc=0.4, size=15)
    assert signed_rank(differences) == pytest.approx(wilcoxon(differences).pvalue)
    assert signed_rank(-differences) == pytest.approx(signed_rank(differences))


def test_signed_rank_leaves_out_what_does_not_differ(random):
    differences = random.normal(loc=0.4, size=12)
    with_zeros = np.concatenate([differences, np.zeros(4)])
    assert signed_rank(with_zeros) == pytest.approx(signed_rank(differences))
    assert signed_rank(np.zeros(12)) == 1.0
    assert signed_rank(differences[: MIN_SAMPLES - 1]) is None


def test_signed_rank_takes_equal_differences():
    p = signed_rank(np.array([1.0, 1.0, 1.0, -1.0, 1.0, 1.0, 1.0, 1.0]))
    assert 0.0 < p < 1.0


def test_holm_multiplies_by_the_number_of_tests_that_are_left():
    """The example that Holm's rule is explained with: the third may not fall below the second."""
    assert holm([0.01, 0.04, 0.03]) == pytest.approx([0.03, 0.06, 0.06])
    assert holm([0.5, None, 0.9]) == [1.0, None, 1.0]
    assert holm([]) == []


def test_best_method_is_compared_with_each_other_one():
    errors = measures(a=[3.0] * 7, b=[1.0, 2.0, 1.0, 2.0, 1.0, 2.0, 4.0], c=[5.0] * 7)
    pairs = compared(errors, FIGURE)
    assert [(pair.method, pair.other) for pair in pairs] == [("b", "a"), ("b", "c")]
    first = pairs[0]
    assert (first.n, first.won, first.tied, first.difference) == (7, 6, 0, -1.0)
    low, high = first.interval
    assert low <= -1.0 <= high
    assert first.p <= first.p_holm <= 2.0 * first.p


def test_chosen_pairs_join_once():
    errors = measures(a=[1.0] * 6, b=[2.0] * 6, c=[3.0] * 6)
    pairs = compared(errors, FIGURE, [("b", "a"), ("c", "b"), ("b", "c")])
    assert [(pair.method, pair.other) for pair in pairs] == [("a", "b"), ("a", "c"), ("c", "b")]


def test_pairs_are_of_the_recordings_that_both_finished():
    errors = measures(a=[1.0, None, 1.0, 1.0], b=[2.0, 0.0, None, 1.0])
    (pair,) = compared(errors, FIGURE)
    assert (pair.method, pair.n, pair.won, pair.tied) == ("a", 2, 1, 1)
    assert pair.interval is pair.p is pair.p_holm is None


def test_methods_without_a_common_recording_are_not_compared():
    assert compared(measures(a=[1.0, None], b=[None, 1.0]), FIGURE) == []
    assert compared(measures(a=[1.0]), FIGURE) == []
    assert compared({}, FIGURE) == []


def test_identical_methods_do_not_differ():
    errors = measures(a=[1.0, 2.0, 3.0, 4.0, 5.0, 6.0], b=[1.0, 2.0, 3.0, 4.0, 5.0, 6.0])
    (pair,) = compared(errors, FIGURE)
    assert (pair.won, pair.tied, pair.difference, pair.p, pair.p_holm) == (0, 6, 0.0, 1.0, 1.0)
    assert pair.interval == (0.0, 0.0)
