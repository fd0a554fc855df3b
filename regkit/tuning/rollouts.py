"""Rollouts: samples that a tracker follows from their true start, and where it ends."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from regkit.body import ListedShape, ShapeParameters
from regkit.interfaces import Past, Registrar, Tracker
from regkit.skeleton import Pose
from regkit.system.arrays import Array, Indices
from regkit.tuning.samples import Sample
from regkit.tuning.sensitivity import sensitivity
from regkit.tuning.tunable import Tunable

VARIED = 0.05
"""Variation of the independent parameters in differences, in their units."""

LIMB = 0.5
"""Error from which a marker counts less, in radii of a typical limb: lost limbs do not decide.

Chosen from two values on the trials of the average person under ``best``.
"""

STEEP = 10.0
"""Largest displacement of a marker per unit parameter that counts, in radii of a typical limb."""


@dataclass(frozen=True)
class NormalEquations:
    """Gauss-Newton equations of the robust squared errors, summed over some frames.

    Attributes:
        matrix: (F, F).
        gradient: (F,).
        frames: Number of frames.
    """

    matrix: Array
    gradient: Array
    frames: int

    def __add__(self, other: NormalEquations) -> NormalEquations:
        """Returns the sum over the frames of both."""
        return NormalEquations(
            self.matrix + other.matrix, self.gradient + other.gradient, self.frames + other.frames
        )


@dataclass(frozen=True)
class Rollouts:
    """The samples of one process, and what a method makes of them.

    Attributes:
        tunable: What is tuned.
        samples: The samples.
    """

    tunable: Tunable
    samples: Sequence[Sample]

    def errors(self, parameters: Array) -> Array:
        """Returns the markers' errors in all frames but the first, (K, L - 1, M, 3) [m].

        Args:
            parameters: Independent parameters of the primitives, (F,).
        """
        return errors_of(self.tunable, self.samples, [self.tunable.primitives(parameters)])[0]

    def normal_equations(self, parameters: Array) -> list[NormalEquations]:
        """Returns the Gauss-Newton equations of the errors in the last frame of each sample, (K,).

        Args:
            parameters: Independent parameters of the primitives, (F,).
        """
        registrar = self.tunable.registrar(parameters)
        varied = self.tunable.varied(parameters, VARIED)
        radius = registrar.body.limb_radius
        each = []
        for sample in self.samples:
            pose = _followed(registrar, self.tunable.tracker, sample)[-1]
            markers = _markers(self.tunable, sample)
            error = _error(registrar, pose, sample.markers[-1], markers)
            rows = sensitivity(
                registrar, varied, VARIED, sample.observations[-1], pose, markers
            ) / radius  # fmt: skip
            rows *= min(1.0, STEEP / max(float(np.abs(rows).max()), 1e-12))
            weights = np.repeat(robust_weights(error, radius), 3)
            matrix = rows.T @ (weights[:, None] * rows)
            gradient = rows.T @ (weights * error.ravel() / radius)
            each.append(NormalEquations(matrix, gradient, 1))
        return each


def errors_of(
    tunable: Tunable, samples: Iterable[Sample], each: Sequence[ListedShape[ShapeParameters]]
) -> list[Array]:
    """Returns the markers' errors in all frames but the first, (K, L - 1, M, 3) [m].

    Args:
        tunable: What is tuned.
        samples: The samples, each needed once.
        each: Several lists of primitives.
    """
    registrars = [tunable.bound(primitives) for primitives in each]
    errors: list[list[Array]] = [[] for _ in each]
    for sample in samples:
        markers = _markers(tunable, sample)
        for registrar, own in zip(registrars, errors, strict=True):
            poses = _followed(registrar, tunable.tracker, sample)
            frames = zip(poses[1:], sample.markers[1:], strict=True)
            own.append(np.array([_error(registrar, *frame, markers) for frame in frames]))
    return [np.array(own) for own in errors]


def robust_costs(errors: Array, radius: float) -> Array:
    """Returns half the squared errors (...) in radii of a typical limb, by Cauchy's loss.

    Args:
        errors: Displacements, (..., 3) [m].
        radius: Radius of a typical limb [m].
    """
    squares = (errors**2).sum(axis=-1) / radius**2
    return np.asarray(0.5 * LIMB**2 * np.log1p(squares / LIMB**2))


def robust_weights(errors: Array, radius: float) -> Array:
    """Returns the weights (...) of squared errors that ``robust_costs`` gives them."""
    return np.asarray(1.0 / (1.0 + (errors**2).sum(axis=-1) / (LIMB * radius) ** 2))


def _followed(registrar: Registrar, tracker: Tracker, sample: Sample) -> list[Pose]:
    """Returns the poses of a sample's frames, tracked from the truth."""
    bound, past, poses = tracker.bind(registrar), Past.start(sample.starts[0]), []
    for observation in sample.observations:
        found = bound.step(observation, past)
        past = past.followed_by(found)
        poses.append(found.pose)
    return poses


def _markers(tunable: Tunable, sample: Sample) -> Indices:
    """Returns the indices of the body's markers whose truth a sample has, (M,)."""
    names = tunable.body.markers.names
    return np.array([names.index(name) for name in sample.names], dtype=np.intp)


def _error(registrar: Registrar, pose: Pose, truth: Array, markers: Indices) -> Array:
    body = registrar.body
    return body.markers.place(body.place(pose).transforms)[markers] - truth
