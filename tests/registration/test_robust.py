"""Laws of the robust losses."""

import numpy as np
import pytest
from pydantic import ValidationError

from regkit.registration.robust import Robust, median_scale

LOSSES = ["squares", "huber", "tukey", "geman_mcclure"]
SCALE = 0.02


def bound(loss: str):
    return Robust(loss=loss, scale=SCALE).bound(np.zeros(3), least=1.0)


@pytest.mark.parametrize("loss", LOSSES)
def test_slope_is_the_derivative_and_weight_times_residual(loss, random):
    loss = bound(loss)
    residuals = random.normal(scale=4.0 * SCALE, size=300)
    step = 1e-7
    numerical = (loss.values(residuals + step) - loss.values(residuals - step)) / (2.0 * step)
    np.testing.assert_allclose(loss.gradient(residuals), numerical, atol=1e-5 / SCALE)
    np.testing.assert_allclose(loss.weights(residuals) * residuals, loss.gradient(residuals))


@pytest.mark.parametrize("loss", LOSSES)
def test_loss_is_half_the_square_in_scales_near_zero(loss):
    loss = bound(loss)
    small = 1e-3 * SCALE * np.array([-1.0, 0.0, 0.5, 1.0])
    np.testing.assert_allclose(loss.values(small), 0.5 * (small / SCALE) ** 2, rtol=1e-5)
    np.testing.assert_allclose(loss.weights(small), 1.0 / SCALE**2, rtol=1e-5)
    np.testing.assert_allclose(loss.inlier_probability(small), 1.0, rtol=1e-5)


@pytest.mark.parametrize("loss", LOSSES)
def test_loss_grows_with_the_residual_and_shares_fall(loss):
    loss = bound(loss)
    residuals = SCALE * np.linspace(0.0, 30.0, 500)
    assert (np.diff(loss.values(residuals)) >= 0.0).all()
    shares = loss.inlier_probability(residuals)
    assert (np.diff(shares) <= 0.0).all()
    assert ((shares >= 0.0) & (shares <= 1.0)).all()
    np.testing.assert_array_equal(loss.values(-residuals), loss.values(residuals))


def test_limits_far_away():
    far = np.array([1e4 * SCALE])
    assert bound("tukey").values(far)[0] == pytest.approx(4.685**2 / 6.0)
    assert bound("tukey").gradient(far)[0] == 0.0
    assert bound("geman_mcclure").values(far)[0] == pytest.approx(3.787**2 / 2.0, rel=1e-6)
    assert bound("geman_mcclure").gradient(far)[0] == pytest.approx(0.0, abs=1e-6)
    assert bound("huber").gradient(far)[0] == pytest.approx(1.345 / SCALE)
    assert bound("squares").gradient(far)[0] == pytest.approx(1e4 / SCALE)


@pytest.mark.parametrize("loss", LOSSES[1:])
def test_efficiency_on_normal_residuals_is_95_percent(loss):
    """Of the mean that each loss defines: (E psi')^2 / E psi^2, by the rule of Stein."""
    nodes, step = np.linspace(-9.0, 9.0, 200_001, retstep=True)
    density = step * np.exp(-0.5 * nodes**2) / np.sqrt(2.0 * np.pi)
    psi = SCALE * bound(loss).gradient(SCALE * nodes)
    # The mean of the derivative of psi is that of u psi(u).
    efficiency = (density @ (nodes * psi)) ** 2 / (density @ psi**2)
    assert efficiency == pytest.approx(0.95, abs=1e-3)


def test_scale_of_normal_residuals_is_their_deviation_in_spite_of_outliers(random):
    normal = random.normal(scale=0.03, size=20_001)
    assert median_scale(normal) == pytest.approx(0.03, rel=0.03)
    spoilt = np.concatenate([normal, np.full(1000, 50.0)])
    assert median_scale(spoilt) == pytest.approx(0.03, rel=0.1)
    assert Robust().bound(normal, least=1e-3).scale == median_scale(normal)


def test_scale_is_at_least_that_of_the_data_and_blur_widens_it():
    assert Robust().bound(np.zeros(5), least=0.01).scale == 0.01
    assert Robust().bound(np.zeros(5), least=0.03, smoothing=0.04).scale == pytest.approx(0.05)
    assert Robust(scale=0.002).bound(np.ones(5), least=0.01).scale == 0.002


@pytest.mark.parametrize("change", [{"scale": 0.0}, {"scale": -1.0}, {"loss": "welsch"}])
def test_impossible_settings_are_refused(change):
    with pytest.raises(ValidationError):
        Robust(**change)
