"""The unit of work: a sequence is made ready, or a method is run on one that is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from glob import escape
from pathlib import Path

from regkit.experiment.experiment import Experiment
from regkit.experiment.results import Results
from regkit.experiment.starts import start_file, start_of
from regkit.interfaces import Registrar, Sequence
from regkit.metrics import Measure, joint_errors, matched, measured
from regkit.observation import Truth
from regkit.report import Record
from regkit.system.errors import RegkitError
from regkit.system.files import remove_unfinished
from regkit.system.optional import one_thread
from regkit.tracking import Track, TrackedFrame, tracked

Result = Measure | RegkitError | None
"""A track's figures, what went wrong, or nothing of a sequence that is ready."""


@dataclass(frozen=True, eq=False)
class Task:
    """A pure function of an experiment, its results folder, and the names of what is to be done.

    Whoever does it, and however often it is begun, writes the same files to the last bit, but for
    the times.

    Attributes:
        experiment: What it is part of; of its methods one is enough.
        folder: The results folder of the experiment.
        sequence: Name of the sequence.
        method: Name of the method, or None to make the sequence ready for all of them: its data
            are prepared and its start is found.
        setting: Name of the experiment among those of a sweep, or nothing.
    """

    experiment: Experiment
    folder: Path
    sequence: str
    method: str | None
    setting: str = ""

    @property
    def label(self) -> str:
        """What a person would call it."""
        who = "preparing" if self.method is None else f"{self.method} on"
        what = f"{who} {self.sequence}"
        return f"{self.setting}: {what}" if self.setting else what

    def result(self, each_frame: Callable[[], None]) -> Result:
        """Do it.

        Args:
            each_frame: Called between two frames; what it raises beyond ``Exception`` is let pass.

        Returns:
            The figures; an error of any kind is returned as one that can be told.
        """
        results = Results(self.folder)
        try:
            with one_thread():
                if self.method is not None:
                    finished = results.finished(self.method, self.sequence)
                    # A worker can be lost after it has written and before it has answered.
                    return finished or self._tracked(results, self.method, each_frame)
                self._made_ready()
                return None
        except Exception as error:
            if self.method is None:
                place = start_file(self.folder, self.sequence).with_suffix(".error.txt")
            else:
                place = results.sequence_folder(self.method, self.sequence) / "error.txt"
            return results.failed(place, error)

    def _made_ready(self) -> None:
        kept = start_file(self.folder, self.sequence)
        remove_unfinished(kept.parent, escape(kept.name))
        sequence = self._sequence()
        start = start_of(self.experiment, sequence, self.folder)
        truth = self._truth(sequence)
        if truth is not None:
            # A misspelt joint is found before the hours of computing, not after them.
            matched(start.body, truth, self.experiment.dataset.joints)

    def _tracked(self, results: Results, name: str, each_frame: Callable[[], None]) -> Measure:
        remove_unfinished(results.sequence_folder(name, self.sequence))
        sequence = self._sequence()
        start = start_of(self.experiment, sequence, self.folder)
        method = self.experiment.methods[name]
        registrar = method.prepare(start.body)
        frames = []
        for frame in tracked(
            sequence,
            self.experiment.observer,
            registrar,
            method.tracker or self.experiment.tracker,
            start.pose,
        ):
            frames.append(frame)
            each_frame()
        return self._recorded(results, name, frames, registrar, sequence)

    def _recorded(
        self,
        results: Results,
        name: str,
        frames: list[TrackedFrame],
        registrar: Registrar,
        sequence: Sequence,
    ) -> Measure:
        """All that is made of a track: its figures, its picture and its files."""
        track, body, truth = Track.of(frames, registrar), registrar.body, self._truth(sequence)
        joints = self.experiment.dataset.joints
        errors = None if truth is None else joint_errors(track, body, truth, joints)
        measure = measured(track, body, errors, sequence.fps)
        record = Record.of(frames, track, registrar, errors, truth, sequence.fps)
        results.write(name, self.sequence, track, body, measure, record)
        return measure

    def _sequence(self) -> Sequence:
        """The sequence, with all that its frames are read from; no other one is looked at."""
        dataset = self.experiment.dataset.model_copy(update={"sequences": (self.sequence,)})
        (sequence,) = dataset.chosen()
        sequence.prepare()
        return sequence

    def _truth(self, sequence: Sequence) -> Truth | None:
        """The reference joints, if there are any and they are to be compared."""
        return sequence.truth() if self.experiment.dataset.compared else None
