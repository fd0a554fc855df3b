"""What is known of an experiment while it runs, and its results folder."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass, field

from regkit.experiment.experiment import Experiment
from regkit.experiment.reporting import report, summarise
from regkit.experiment.resolved import resolved
from regkit.experiment.results import Results
from regkit.experiment.task import Task
from regkit.metrics import Measure
from regkit.system.errors import RegkitError

WRITTEN_EVERY = 1.0
"""The figures are written no more often than this [s] while the run goes on."""

WRITING = 0.05
"""Nor may writing them take more than this part of the time: of a large sweep it takes seconds."""


@dataclass(frozen=True)
class Outcome:
    """The figures in a results folder, by method and recording, and what failed with its reason."""

    measures: dict[str, dict[str, Measure]]
    failures: dict[str, dict[str, str]]


Track = tuple[str, str]
"""The names of a method and of a recording."""


@dataclass
class Ledger:
    """An experiment's figures so far.

    Attributes:
        experiment: What is run.
        results: Where to.
        methods: Names of the methods that are run now.
        lengths: The number of frames of the dataset's recordings, by their names.
        setting: Name of the experiment among those of a sweep, or nothing.
    """

    experiment: Experiment
    results: Results
    methods: list[str]
    lengths: dict[str, int]
    setting: str = ""
    _measures: dict[Track, Measure] = field(default_factory=dict)
    _failures: dict[Track, str] = field(default_factory=dict)
    _due: float = 0.0

    def open(self, workers: str) -> None:
        """Make the folder of an experiment of a sweep, in that of the sweep.

        Raises:
            RegkitError: If it holds something else.
        """
        self.results.folder.mkdir(exist_ok=True)
        Results.opened(self.results.folder, resolved(self.experiment), workers)

    def read(self) -> Iterator[tuple[str, RegkitError]]:
        """Take in what the folder holds already; what is damaged there counts as failed.

        Of methods that are not run now, what failed before is still to be told.
        """
        failed = self.results.failures()
        for method in self.experiment.methods:
            for recording in self.lengths:
                track = (method, recording)
                try:
                    measure = self.results.finished(method, recording)
                except RegkitError as error:
                    self._failures[track] = str(error)
                    yield self._task(recording, method).label, error
                else:
                    if measure is not None:
                        self._measures[track] = measure
                    elif method not in self.methods and recording in failed.get(method, {}):
                        self._failures[track] = failed[method][recording]

    def tracks(self) -> Iterator[tuple[Task, list[Task]]]:
        """For each recording, the task that makes it ready and those that are still to be done."""
        known = self._measures.keys() | self._failures.keys()
        for recording in self.lengths:
            missing = [method for method in self.methods if (method, recording) not in known]
            if missing:
                opening = self._task(recording, missing[0], opening=True)
                yield opening, [self._task(recording, method) for method in missing]

    @property
    def planned(self) -> int:
        """How many tracks are to be run."""
        return len(self.methods) * len(self.lengths)

    def frames(self, task: Task) -> int | None:
        """How many frames a task will tell of."""
        return None if task.method is None else self.lengths[task.recording]

    @property
    def finished(self) -> int:
        """How many of the tracks to be run are done, or failed before anything was run."""
        known = self._measures.keys() | self._failures.keys()
        return sum((m, s) in known for m in self.methods for s in self.lengths)

    def ended(self, task: Task, result: Measure | RegkitError) -> None:
        """Take in what became of a track."""
        assert task.method is not None
        track = (task.method, task.recording)
        if isinstance(result, RegkitError):
            self._failures[track] = str(result)
        else:
            self._measures[track] = result
        if time.monotonic() > self._due:
            self.summarise()

    @property
    def outcome(self) -> Outcome:
        """Everything in the order of the configuration, whatever was done first."""
        measures: dict[str, dict[str, Measure]] = {}
        failures: dict[str, dict[str, str]] = {}
        for method in self.experiment.methods:
            found = {s: self._measures[t] for s in self.lengths
                     if (t := (method, s)) in self._measures}  # fmt: skip
            failed = {s: self._failures[t] for s in self.lengths
                      if (t := (method, s)) in self._failures}  # fmt: skip
            if found or failed or method in self.methods:
                measures[method], failures[method] = found, failed
        return Outcome(measures, failures)

    def summarise(self) -> None:
        """Write the figures so far."""
        outcome, begun = self.outcome, time.monotonic()
        summarise(self.results.folder, outcome.measures, outcome.failures)
        ended = time.monotonic()
        self._due = ended + max(WRITTEN_EVERY, (ended - begun) / WRITING)

    def report(self, *, figures: bool) -> None:
        """Write the report, with its figures or without."""
        outcome = self.outcome
        report(self.results.folder, outcome.measures, outcome.failures, figures=figures)

    def _task(self, recording: str, method: str, *, opening: bool = False) -> Task:
        # Each worker reads the experiment anew: it shall not read a hundred methods for one.
        methods = {method: self.experiment.methods[method]}
        alone = self.experiment.model_copy(update={"methods": methods})
        chosen = None if opening else method
        return Task(alone, self.results.folder, recording, chosen, self.setting)
