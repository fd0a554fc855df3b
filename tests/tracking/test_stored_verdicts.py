"""Verdicts in files are words of ``Verdict``, one for each frame."""

import numpy as np
import pytest

from regkit.system.errors import DataError
from regkit.tracking import check_verdicts


def test_known_words_are_accepted():
    check_verdicts(np.array(["found", "doubtful", "lost", "no data"]), 4)


@pytest.mark.parametrize(
    "stored",
    [np.array(["found"]), np.array(["found", "Found"]), np.array([[0, 1]]), np.zeros(2)],
)
def test_other_words_and_counts_are_refused(stored):
    with pytest.raises(DataError, match="verdicts"):
        check_verdicts(stored, 2)
