"""State of an experiment during a run, and its results folder."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass, field

from regkit.experiment.earlier import EarlierResults
from regkit.experiment.experiment import Experiment
from regkit.experiment.opening import Opening
from regkit.experiment.provenance.setup import Setup
from regkit.experiment.reporting import report, summarise
from regkit.experiment.resolved import resolved
from regkit.experiment.results import Results
from regkit.experiment.task import Task
from regkit.interfaces import Recording
from regkit.metrics import Measure
from regkit.system.errors import RegkitError

WRITTEN_EVERY = 1.0
"""Minimum time [s] between two writings of the metrics during the run."""

WRITING = 0.05
"""Maximum fraction of the time spent on writing them, which takes seconds in a large sweep."""


@dataclass(frozen=True)
class Outcome:
    """Metrics in a results folder by method and recording, and the reasons of failures."""

    measures: dict[str, dict[str, Measure]]
    failures: dict[str, dict[str, str]]


Track = tuple[str, str]
"""Names of a method and a recording."""


@dataclass
class Ledger:
    """Metrics of an experiment so far.

    Attributes:
        experiment: The experiment.
        results: Its results folder.
        methods: Names of the methods in this run.
        recordings: The recordings, by name.
        setting: Name of the experiment within a sweep; empty without one.
    """

    experiment: Experiment
    results: Results
    methods: list[str]
    recordings: dict[str, Recording]
    setting: str = ""
    _measures: dict[Track, Measure] = field(default_factory=dict)
    _failures: dict[Track, str] = field(default_factory=dict)
    _due: float = 0.0

    @property
    def opening(self) -> Opening:
        """The experiment's folder, to be opened."""
        setup = Setup.of(self.experiment)
        return Opening(self.results.folder, resolved(self.experiment), self.experiment, setup)

    def read(self, moved: str = "") -> EarlierResults:
        """Reads the existing results, and returns them to keep what they tell of the recordings.

        Earlier failures of methods outside this run are included.

        Args:
            moved: Paths that differ from those of an earlier start of the run, in a few words.

        Raises:
            ConfigError: If paths in the configuration differ, and the content there too.
        """
        earlier = EarlierResults(self.experiment, self.results, self.methods, moved)
        failed = earlier.failures()
        for recording in self.recordings.values():
            measures = earlier.measures(recording)
            for method in self.experiment.methods:
                track = (method, recording.name)
                if method in measures:
                    self._measures[track] = measures[method]
                elif method not in self.methods and recording.name in failed.get(method, {}):
                    self._failures[track] = failed[method][recording.name]
        earlier.tell_others(list(self.recordings))
        return earlier

    def tracks(self) -> Iterator[tuple[Task, list[Task]]]:
        """Yields each recording's preparation with its unfinished tracks."""
        known = self._measures.keys() | self._failures.keys()
        for recording in self.recordings:
            missing = [method for method in self.methods if (method, recording) not in known]
            if missing:
                opening = self._task(recording, missing[0], opening=True)
                yield opening, [self._task(recording, method) for method in missing]

    @property
    def planned(self) -> int:
        """Returns the number of tracks in this run."""
        return len(self.methods) * len(self.recordings)

    def frames(self, task: Task) -> int | None:
        """Returns the number of frames that a task reports."""
        return None if task.method is None else self.recordings[task.recording].length

    @property
    def finished(self) -> int:
        """Returns the number of tracks in this run that are finished or have failed already."""
        known = self._measures.keys() | self._failures.keys()
        return sum((m, s) in known for m in self.methods for s in self.recordings)

    def ended(self, task: Task, result: Measure | RegkitError) -> None:
        """Records the result of a track."""
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
        """Returns all results in the order of the configuration."""
        measures: dict[str, dict[str, Measure]] = {}
        failures: dict[str, dict[str, str]] = {}
        for method in self.experiment.methods:
            found = {s: self._measures[t] for s in self.recordings
                     if (t := (method, s)) in self._measures}  # fmt: skip
            failed = {s: self._failures[t] for s in self.recordings
                      if (t := (method, s)) in self._failures}  # fmt: skip
            if found or failed or method in self.methods:
                measures[method], failures[method] = found, failed
        return Outcome(measures, failures)

    def summarise(self) -> None:
        """Writes the metrics so far."""
        outcome, begun = self.outcome, time.monotonic()
        summarise(self.results.folder, outcome.measures, outcome.failures)
        ended = time.monotonic()
        self._due = ended + max(WRITTEN_EVERY, (ended - begun) / WRITING)

    def report(self, *, figures: bool) -> None:
        """Writes the report, with or without figures."""
        outcome = self.outcome
        report(self.results.folder, outcome.measures, outcome.failures, figures=figures)

    def _task(self, recording: str, method: str, *, opening: bool = False) -> Task:
        # Each worker validates the experiment again, which is faster with only its own method.
        methods = {method: self.experiment.methods[method]}
        alone = self.experiment.model_copy(update={"methods": methods})
        chosen = None if opening else method
        return Task(alone, self.results.folder, recording, chosen, self.setting)
