"""Data from which no pose follows are refused with their reason."""

import numpy as np
import pytest

from regkit.observation import Observation
from regkit.system.errors import DataError
from regkit.testing.samples import linkage
from regkit_plugins.kernels.likelihood import Likelihood
from regkit_plugins.shapes.gsog import GeneralizedSumOfGaussians


def test_an_observation_without_points_is_refused():
    with pytest.raises(DataError, match="no points"):
        Observation(np.zeros((0, 3)), np.zeros(0), np.zeros(0))


@pytest.mark.parametrize("name", ["weights", "variances"])
def test_arrays_of_another_length_are_refused(name):
    arrays = {"points": np.zeros((4, 3)), "weights": np.ones(4), "variances": np.ones(4)}
    with pytest.raises(DataError, match=name):
        Observation(**arrays | {name: np.ones(3)})


def test_a_likelihood_of_coincident_points_is_refused():
    body = linkage()
    placed = (
        GeneralizedSumOfGaussians().bind(body).place(body.place(body.skeleton.rest()).transforms)
    )
    data = Observation(np.ones((20, 3)), np.ones(20), np.full(20, 1e-4))
    with pytest.raises(DataError, match=r"20 points .* coincide"):
        Likelihood().bind(data, placed)
