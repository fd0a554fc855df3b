"""The Kalman filter and the Rauch-Tung-Striebel smoother of positions with damped velocities."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.system.arrays import Array


@dataclass(frozen=True)
class Motion:
    """A motion of m positions whose velocities change at random.

    Attributes:
        change: Covariance of the velocities' change in a frame, (m, m).
        damping: Share of a velocity that lasts to the next frame.
        position: Covariance of the positions in the first frame, (m, m).
        velocity: Covariance of the velocities in the first frame, (m, m).
    """

    change: Array
    damping: float
    position: Array
    velocity: Array

    @property
    def transition(self) -> Array:
        """F, (2m, 2m): a position moves by its velocity, which fades."""
        one = np.eye(len(self.change))
        return np.block([[one, one], [np.zeros_like(one), self.damping * one]])

    @property
    def noise(self) -> Array:
        """Q, (2m, 2m): a change of the velocity moves the position by half of it."""
        return np.block([
            [0.25 * self.change, 0.5 * self.change],
            [0.5 * self.change, self.change],
        ])  # fmt: skip

    @property
    def first(self) -> Array:
        """P in the first frame, (2m, 2m)."""
        nothing = np.zeros_like(self.change)
        return np.block([[self.position, nothing], [nothing, self.velocity]])


def smoothed_states(
    steps: Array, information: Array, pulls: Array, motion: Motion
) -> tuple[Array, Array]:
    """Returns the offsets (T, m) of positions from a reference, and their covariances (T, m, m).

    The log-likelihood of a frame at the offset d is y^T d - d^T Y d / 2. Source: Rauch, Tung and
    Striebel, Maximum likelihood estimates of linear dynamic systems, AIAA Journal 3, 1965.

    Args:
        steps: Steps of the reference between frames, (T - 1, m).
        information: Y of each frame, (T, m, m), possibly singular.
        pulls: y of each frame, (T, m).
        motion: The motion.
    """
    frames, size = pulls.shape
    transition, noise = motion.transition, motion.noise
    states, covariances = np.zeros((frames, 2 * size)), np.empty((frames, 2 * size, 2 * size))
    expected, predicted = np.zeros_like(states), np.empty_like(covariances)
    expected[0], predicted[0] = 0.0, motion.first
    for frame in range(frames):
        state, before = expected[frame], predicted[frame]
        # Without the inverse of Y, which tells nothing of what is hidden.
        known = information[frame]
        gain = np.linalg.solve(
            np.eye(size) + known @ before[:size, :size], np.hstack([known, pulls[frame, :, None]])
        )
        residual = gain[:, -1] - gain[:, :-1] @ state[:size]
        states[frame] = state + before[:, :size] @ residual
        after = before - before[:, :size] @ gain[:, :-1] @ before[:size]
        covariances[frame] = 0.5 * (after + after.T)
        if frame + 1 < frames:
            expected[frame + 1] = transition @ states[frame]
            expected[frame + 1, :size] -= steps[frame]
            predicted[frame + 1] = transition @ covariances[frame] @ transition.T + noise
    for frame in range(frames - 2, -1, -1):
        gain = np.linalg.solve(predicted[frame + 1], transition @ covariances[frame]).T
        states[frame] += gain @ (states[frame + 1] - expected[frame + 1])
        covariances[frame] += gain @ (covariances[frame + 1] - predicted[frame + 1]) @ gain.T
    return states[:, :size], np.ascontiguousarray(covariances[:, :size, :size])
