"""Points from users, files and frames: what is missing, and what is no measurement."""

import numpy as np
import pytest

from regkit.system.arrays import checked_points, loop_input, measured_points, without_missing
from regkit.system.errors import DataError
from regkit.system.notes import RegkitWarning

MIXED = [[1.0, 2.0, 3.0], [np.nan, 0.0, 0.0], [4.0, 5.0, 6.0], [0.0, -np.inf, 0.0]]
WHOLE = [MIXED[0], MIXED[2]]


def test_missing_measurements_are_dropped_told_or_refused():
    np.testing.assert_array_equal(measured_points(MIXED), WHOLE)
    with pytest.warns(RegkitWarning, match="here: 2 of 4"):
        np.testing.assert_array_equal(without_missing(MIXED, place="here"), WHOLE)
    with pytest.raises(DataError, match="first at point 1"):
        checked_points(MIXED, place="here")
    for check in (measured_points, without_missing, checked_points):
        np.testing.assert_array_equal(check(WHOLE), WHOLE)


@pytest.mark.parametrize("points", [[[1e13, 0.0, 0.0]], [[1.0, 2.0]], [1.0, 2.0, 3.0]])
def test_what_is_no_point_is_refused(points):
    for check in (measured_points, without_missing, checked_points):
        with pytest.raises(DataError, match="here"):
            check(points, place="here")


def test_input_of_loops_is_of_one_kind_and_copied_only_if_it_is_not(random):
    values = random.normal(size=(6, 4))
    assert loop_input(values) is values
    fixed = values.copy()
    fixed.flags.writeable = False
    others = [fixed, np.asfortranarray(values), np.repeat(values, 2, axis=1)[:, ::2]]
    others += [values.astype(">f8"), values[::-1][::-1]]
    for other in others:
        found = loop_input(other)
        assert found.flags.carray
        assert found.dtype == np.float64
        np.testing.assert_array_equal(found, values)
    assert loop_input(values.astype(np.float32)).dtype == np.float64
