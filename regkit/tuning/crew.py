"""Workers that share samples: each renders its own and keeps them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from threading import local
from typing import Any

import numpy as np

from regkit.body import ListedShape, ShapeParameters
from regkit.system.arrays import Array
from regkit.system.optional import one_thread
from regkit.tuning.rollouts import NormalEquations, Rollouts, errors_of
from regkit.tuning.sample_set import SampleSet, Share
from regkit.tuning.tunable import Tunable
from regkit.tuning.workers import OtherProcess, ThisProcess, Worker


class _Kept(local):
    """The samples that this thread keeps, by the names of their sets."""

    def __init__(self) -> None:
        self.sets: dict[str, Rollouts] = {}


_KEPT = _Kept()


@dataclass(frozen=True)
class Crew:
    """Some workers, each of which has a share of every set of samples.

    Attributes:
        tunable: What is tuned.
        workers: The workers, with which their samples stay.
        sets: The sets that they keep.
    """

    tunable: Tunable
    workers: Sequence[Worker]
    sets: Mapping[str, SampleSet]

    def render(self) -> list[str]:
        """Renders the sets that are kept.

        Returns:
            Why samples could not be rendered, in whose place there are others.

        Raises:
            RegkitError: If too many samples in succession cannot be rendered.
        """
        # One task renders all: a process whose memory grows after its first task is replaced.
        shares = zip(*(self._shares(one) for one in self.sets.values()), strict=True)
        failures = self._each(_render, [(self.tunable, own) for own in shares])
        return [reason for own in failures for reason in own]

    def errors(self, name: str, parameters: Array) -> Array:
        """Returns the errors of ``Rollouts.errors`` for a kept set, in its order."""
        shares = self._shares(self.sets[name])
        return self._joined(
            self._each(_errors, [(self.tunable, own, parameters) for own in shares])
        )

    def normal_equations(self, name: str, parameters: Array) -> NormalEquations:
        """Returns the sum of ``Rollouts.normal_equations`` over a kept set.

        It is added up in the set's order, so that it is the same for any number of workers.
        """
        shares = self._shares(self.sets[name])
        parts = self._each(_normal_equations, [(self.tunable, own, parameters) for own in shares])
        count = len(parts)
        first, *others = [parts[at % count][at // count] for at in range(self.sets[name].count)]
        total: NormalEquations = sum(others, first)
        return total

    def tried(
        self, trial: SampleSet, each: Sequence[ListedShape[ShapeParameters]]
    ) -> tuple[list[Array], list[str]]:
        """Returns the errors of several lists of primitives on a set that is not kept.

        Returns:
            The errors of each list, and why samples could not be rendered, as in ``render``.

        Raises:
            RegkitError: If too many samples in succession cannot be rendered.
        """
        found = self._each(_tried, [(self.tunable, own, each) for own in self._shares(trial)])
        parts = [errors for errors, _ in found]
        failures = [reason for _, own in found for reason in own]
        return [self._joined(of_one) for of_one in zip(*parts, strict=True)], failures

    def _shares(self, one: SampleSet) -> list[Share]:
        return [Share(one, first, len(self.workers)) for first in range(len(self.workers))]

    def _joined(self, parts: Sequence[Array]) -> Array:
        """Returns the errors of a whole set, from those of each share."""
        whole = np.empty((sum(map(len, parts)), *parts[0].shape[1:]))
        for first, part in enumerate(parts):
            if len(part):
                whole[first :: len(parts)] = part
        return whole

    def _each(self, function: Any, arguments: Sequence[tuple[Any, ...]]) -> list[Any]:
        results = [
            worker.begin(function, *own)
            for worker, own in zip(self.workers, arguments, strict=True)
        ]
        return [result() for result in results]


@contextmanager
def crew(tunable: Tunable, sets: Sequence[SampleSet], jobs: int) -> Iterator[Crew]:
    """Starts the workers of a crew, and ends them.

    Args:
        tunable: What is tuned.
        sets: The sets that the workers keep.
        jobs: Number of processes; one is this process.
    """
    workers: list[Worker] = [ThisProcess(_KEPT.sets.clear)]
    if jobs > 1:
        workers = [OtherProcess() for _ in range(jobs)]
    try:
        # The last bits of matrix products depend on the number of their threads.
        with one_thread():
            yield Crew(tunable, workers, {one.name: one for one in sets})
    finally:
        for worker in workers:
            worker.end()


def _render(tunable: Tunable, shares: Sequence[Share]) -> list[str]:
    """Runs on a worker: renders its shares."""
    failures: list[str] = []
    for share in shares:
        _KEPT.sets[share.whole.name] = Rollouts(tunable, list(share.samples(failures)))
    return failures


def _kept(tunable: Tunable, share: Share) -> Rollouts:
    """Returns a share; a process that replaces another one renders it again."""
    if share.whole.name not in _KEPT.sets:
        _render(tunable, [share])
    return _KEPT.sets[share.whole.name]


def _errors(tunable: Tunable, share: Share, parameters: Array) -> Array:
    return _kept(tunable, share).errors(parameters)


def _normal_equations(tunable: Tunable, share: Share, parameters: Array) -> list[NormalEquations]:
    return _kept(tunable, share).normal_equations(parameters)


def _tried(
    tunable: Tunable, share: Share, each: Sequence[ListedShape[ShapeParameters]]
) -> tuple[list[Array], list[str]]:
    # A process whose memory grows is replaced, so that no sample is kept.
    failures: list[str] = []
    return errors_of(tunable, share.samples(failures), each), failures
