"""Trials on samples that tuning never sees: the errors before and after."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.system.arrays import Array

LOST = 0.06
"""Error of a marker whose limb is lost, in sizes of the body: 10 cm of a person."""

DOUBT = 2.0
"""A change is worse if it exceeds its standard error by this factor."""


@dataclass(frozen=True)
class Errors:
    """Errors of all markers in all frames of a trial.

    Attributes:
        mean: Mean distance to the truth [m].
        median: Median distance [m].
        lost: Fraction of the markers whose limb is lost.
    """

    mean: float
    median: float
    lost: float

    @classmethod
    def of(cls, distances: Array, size: float) -> Errors:
        """Returns the errors of distances (...) [m] on a body of a size [m]."""
        lost = (distances > LOST * size).mean()
        return cls(float(distances.mean()), float(np.median(distances)), float(lost))


@dataclass(frozen=True)
class Comparison:
    """A trial before and after tuning.

    Attributes:
        name: Name of the trial.
        samples: Number of samples.
        frames: Number of frames of each.
        before: Errors before.
        after: Errors after.
        change: Mean change of a sample's mean distance [m]; negative if tuning has helped.
        doubt: Its standard error [m].
    """

    name: str
    samples: int
    frames: int
    before: Errors
    after: Errors
    change: float
    doubt: float

    @classmethod
    def of(cls, name: str, before: Array, after: Array, size: float) -> Comparison:
        """Compares errors (K, L, M, 3) [m] of the same samples.

        Args:
            name: Name of the trial.
            before: Errors before tuning.
            after: Errors after tuning.
            size: Size of the body [m].
        """
        first, then = (np.linalg.norm(errors, axis=-1) for errors in (before, after))
        changes = (then - first).mean(axis=(1, 2))
        return cls(
            name=name,
            samples=len(before),
            frames=before.shape[1],
            before=Errors.of(first, size),
            after=Errors.of(then, size),
            change=float(changes.mean()),
            doubt=float(changes.std(ddof=1) / np.sqrt(len(changes))),
        )

    @property
    def worse(self) -> bool:
        """Whether tuning has done harm, beyond what the choice of samples may explain."""
        return self.change > DOUBT * self.doubt

    @property
    def better(self) -> bool:
        """Whether tuning has helped, beyond what the choice of samples may explain."""
        return self.change < -DOUBT * self.doubt
