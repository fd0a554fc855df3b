"""Running an experiment: every method on every sequence, what is finished being kept."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import islice
from pathlib import Path
from typing import Protocol

from regkit.errors import ConfigError, RegkitError
from regkit.experiment.experiment import Experiment
from regkit.experiment.results import Results
from regkit.interfaces import Method, Sequence
from regkit.metrics import Measure, matched, measured
from regkit.model import did_you_mean
from regkit.observation import Observation, Truth
from regkit.optional import one_blas_thread
from regkit.report import draw_overlay, report
from regkit.start import Start, found_start, given_start
from regkit.tracking import Track, tracked


class Progress(Protocol):
    """Who wants to know how far a run is."""

    def begin(self, method: str, sequence: str, frames: int) -> None:
        """A method starts on a sequence."""

    def advance(self) -> None:
        """One more frame is done."""

    def end(self, method: str, sequence: str, outcome: Measure | RegkitError) -> None:
        """The sequence is finished, or could not be."""


@dataclass(frozen=True)
class Outcome:
    """The figures in a results folder, by method and sequence, and what failed with its reason."""

    measures: dict[str, dict[str, Measure]]
    failures: dict[str, dict[str, str]]


def run(
    experiment: Experiment, folder: Path, progress: Progress, *, only: Iterable[str] = ()
) -> Outcome:
    """Run an experiment into its folder; what the folder holds already is not done again.

    A sequence that fails does not stop the others. After each one the metrics and the report are
    written anew, over all that the folder holds.

    Args:
        experiment: What to run.
        folder: Where to.
        progress: Who is told.
        only: Names of the methods to run; all of them if it is empty.

    Raises:
        RegkitError: If nothing can be run: an unknown method, a dataset without sequences, a folder
            that holds something else.
    """
    methods = _chosen(experiment, tuple(only))
    sequences = experiment.dataset.chosen()
    results = Results.opened(folder, experiment)
    outcome = Outcome({name: {} for name in methods}, {name: {} for name in methods})
    others = [name for name in experiment.methods if name not in methods]
    outcome.measures.update(_finished(results, others, sequences))
    with one_blas_thread():
        for sequence in sequences:
            task = _Task(experiment, results, sequence)
            for name, method in methods.items():
                progress.begin(name, sequence.name, sequence.length)
                try:
                    measure = task.measure(name, method, progress)
                except Exception as error:
                    failure = results.failed(name, sequence.name, error)
                    outcome.failures[name][sequence.name] = str(failure)
                    progress.end(name, sequence.name, failure)
                else:
                    outcome.measures[name][sequence.name] = measure
                    progress.end(name, sequence.name, measure)
                results.write_metrics(outcome.measures, outcome.failures)
                results.write_report(report(experiment.name, outcome.measures, outcome.failures))
    return outcome


@dataclass(frozen=True)
class _Task:
    """One sequence, which every method gets with the same start."""

    experiment: Experiment
    results: Results
    sequence: Sequence

    def measure(self, name: str, method: Method, progress: Progress) -> Measure:
        """The figures of a method, tracked now or found in the results folder."""
        finished = self.results.finished(name, self.sequence.name)
        if finished is not None:
            return finished
        joints = self.experiment.dataset.joints
        if self.truth is not None:
            # A misspelt joint is found before the hours of computing, not after them.
            matched(self.start.body, self.truth, joints)
        registrar = method.prepare(self.start.body)
        frames = []
        for frame in tracked(
            self.sequence,
            self.experiment.observer,
            registrar,
            method.tracker or self.experiment.tracker,
            self.start.pose,
        ):
            frames.append(frame)
            progress.advance()
        track = Track.of(frames, registrar)
        measure = measured(track, registrar.body, self.truth, joints)
        picture = self.results.sequence_folder(name, self.sequence.name) / "overlay.png"
        title = f"{name} on {self.sequence.name}"
        draw_overlay(picture, title, frames, track, registrar, self.truth)
        sequence = self.sequence
        self.results.write(name, sequence.name, track, registrar.body, measure, sequence.fps)
        return measure

    @cached_property
    def truth(self) -> Truth | None:
        """The reference joints, if there are any and they are to be compared."""
        return self.sequence.truth() if self.experiment.dataset.compared else None

    @cached_property
    def start(self) -> Start:
        """The given start, or the one found in the first frame, its size in a few."""
        if self.experiment.start is not None:
            return given_start(self.experiment.template, self.experiment.start)
        return found_start(self.experiment.template, *self._looked_at())

    def _looked_at(self) -> Iterator[Observation]:
        """The first frame, and two later ones where the size is unknown and they can be used."""
        sized = self.experiment.template.given_size() is not None
        last = self.sequence.length - 1
        wanted = {0} if sized else {0, last // 2, last}
        for index, frame in enumerate(islice(self.sequence.frames(), 1 + max(wanted))):
            if index not in wanted:
                continue
            try:
                yield self.experiment.observer.observe(frame)
            except RegkitError as error:
                # What is wrong with a later frame is told when it is tracked.
                if index == 0:
                    raise error.at(frame.place or self.sequence.name) from None


def _finished(
    results: Results, methods: list[str], sequences: list[Sequence]
) -> dict[str, dict[str, Measure]]:
    """What the folder holds of methods that are not run now."""
    found: dict[str, dict[str, Measure]] = {}
    for method in methods:
        for sequence in sequences:
            measure = results.finished(method, sequence.name)
            if measure is not None:
                found.setdefault(method, {})[sequence.name] = measure
    return found


def _chosen(experiment: Experiment, only: tuple[str, ...]) -> dict[str, Method]:
    for name in only:
        if name not in experiment.methods:
            known = list(experiment.methods)
            raise ConfigError(
                f"no method '{name}' (there are: {', '.join(known)})" + did_you_mean(name, known),
                place="--only",
            )
    return {name: experiment.methods[name] for name in only or experiment.methods}
