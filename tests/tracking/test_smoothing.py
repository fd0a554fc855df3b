"""The smoother: hidden parts are interpolated, noise falls, and what is not known stays so."""

import numpy as np
import pytest
from made_tracks import made_track
from places import ROOT

from regkit.experiment import Experiment
from regkit.system.errors import ConfigError
from regkit.tracking import Smoothing, smoothed
from regkit.tracking.kalman import Motion, smoothed_states


def motion(size, change=1e-4, damping=1.0):
    one = np.eye(size)
    return Motion(change * one, damping, 4.0 * one, 0.04 * one)


def test_smoothed_states_are_the_least_squares_over_all_frames(random):
    """The two passes find the minimum of one quadratic function of all states."""
    frames, size = 7, 2
    moving = motion(size, change=0.01, damping=0.8)
    steps = 0.1 * random.normal(size=(frames - 1, size))
    roots = random.normal(size=(frames, size, size))
    information = roots @ roots.transpose(0, 2, 1)
    information[2] = 0.0  # A frame without data.
    information[4, 0] = information[4, :, 0] = 0.0  # A position that is hidden.
    pulls = random.normal(size=(frames, size))
    pulls[2] = pulls[4, 0] = 0.0
    found, covariances = smoothed_states(steps, information, pulls, moving)
    # The normal equations of all frames at once; a little noise makes Q invertible.
    whole = np.zeros((frames * 2 * size, frames * 2 * size))
    right = np.zeros(frames * 2 * size)
    whole[: 2 * size, : 2 * size] = np.linalg.inv(moving.first)
    weight = np.linalg.inv(moving.noise + 1e-10 * np.eye(2 * size))
    for frame in range(frames):
        at = slice(frame * 2 * size, frame * 2 * size + size)
        whole[at, at] += information[frame]
        right[at] += pulls[frame]
        if frame:
            before = slice((frame - 1) * 2 * size, frame * 2 * size)
            now = slice(frame * 2 * size, (frame + 1) * 2 * size)
            jacobian = np.zeros((2 * size, len(right)))
            jacobian[:, now] = np.eye(2 * size)
            jacobian[:, before] = -moving.transition
            offset = np.concatenate([-steps[frame - 1], np.zeros(size)])
            whole += jacobian.T @ weight @ jacobian
            right += jacobian.T @ weight @ offset
    states = np.linalg.solve(whole, right).reshape(frames, 2, size)[:, 0]
    inverse = np.linalg.inv(whole).reshape(frames, 2, size, frames, 2, size)
    np.testing.assert_allclose(found, states, atol=1e-4)
    for frame in range(frames):
        expected = inverse[frame, 0, :, frame, 0]
        np.testing.assert_allclose(covariances[frame], expected, rtol=1e-3, atol=1e-6)


def test_gap_is_filled_along_the_motion_and_is_the_least_certain(random):
    """A position that moves evenly, and is not seen for ten frames."""
    frames = 40
    truth = 0.02 * np.arange(frames)
    seen = np.ones(frames, dtype=bool)
    seen[15:25] = False
    tracked = truth + 0.005 * random.normal(size=frames)
    tracked[15:25] = tracked[14]  # It stays where it was last seen.
    information = np.where(seen, 1.0 / 0.005**2, 0.0)[:, None, None]
    offsets, covariances = smoothed_states(
        np.diff(tracked)[:, None], information, np.zeros((frames, 1)), motion(1, change=1e-7)
    )
    found = tracked + offsets[:, 0]
    assert np.abs(found - truth).max() < 0.01
    assert np.abs(tracked - truth)[24] > 0.15
    assert np.std(np.diff(found - truth, 2)) < 0.2 * np.std(np.diff((tracked - truth)[:14], 2))
    deviations = np.sqrt(covariances[:, 0, 0])
    # The first and the last frames have neighbours on one side only.
    assert deviations[8:32].argmax() + 8 in range(15, 25)
    assert deviations[19] > 1.3 * deviations[10]


def test_track_without_information_is_refused(linkage):
    with pytest.raises(ConfigError, match="cannot be smoothed"):
        smoothed(made_track(linkage, 5), linkage)


def test_experiment_names_the_refinement_or_its_settings():
    file = ROOT / "docs" / "examples" / "demo.yaml"
    assert Experiment.read(file).refine is None
    assert Experiment.read(file, ("refine=smooth",)).refine == Smoothing()
    found = Experiment.read(file, ("refine={joint_deg: 2}",)).refine
    assert found == Smoothing(joint_deg=2.0)
    with pytest.raises(ConfigError, match=r"refine: .*'sharpen'; write smooth"):
        Experiment.read(file, ("refine=sharpen",))
