"""The unit of work: a recording is made ready, or a method is run on one that is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from glob import escape
from pathlib import Path

from regkit.experiment.experiment import Experiment
from regkit.experiment.results import Results
from regkit.experiment.starts import kept_start, start_file
from regkit.interfaces import Registrar
from regkit.metrics import Measure, joint_errors, matched, measured
from regkit.observation import Truth
from regkit.report import Record
from regkit.system.errors import RegkitError
from regkit.system.files import remove_unfinished
from regkit.system.optional import one_thread
from regkit.tracking import Session, TrackRecorder

Result = Measure | RegkitError | None
"""A track's figures, what went wrong, or nothing of a recording that is ready."""


@dataclass(frozen=True, eq=False)
class Task:
    """A pure function of an experiment, its results folder, and the names of what is to be done.

    Whoever does it, and however often it is begun, writes the same files to the last bit, but for
    the times.

    Attributes:
        experiment: What it is part of; of its methods one is enough.
        folder: The results folder of the experiment.
        recording: Name of the recording.
        method: Name of the method, or None to make the recording ready for all of them: its data
            are prepared and its start is found.
        setting: Name of the experiment among those of a sweep, or nothing.
    """

    experiment: Experiment
    folder: Path
    recording: str
    method: str | None
    setting: str = ""

    @property
    def label(self) -> str:
        """What a person would call it."""
        who = "preparing" if self.method is None else f"{self.method} on"
        what = f"{who} {self.recording}"
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
                    finished = results.finished(self.method, self.recording)
                    # A worker can be lost after it has written and before it has answered.
                    return finished or self._tracked(results, self.method, each_frame)
                self._made_ready()
                return None
        except Exception as error:
            if self.method is None:
                place = start_file(self.folder, self.recording).with_suffix(".error.txt")
            else:
                place = results.recording_folder(self.method, self.recording) / "error.txt"
            return results.failed(place, error)

    def _made_ready(self) -> None:
        kept = start_file(self.folder, self.recording)
        remove_unfinished(kept.parent, escape(kept.name))
        session = self._session()
        start = kept_start(session, self.folder)
        truth = self._truth(session)
        if truth is not None:
            # A misspelt joint is found before the hours of computing, not after them.
            matched(start.body, truth, self.experiment.dataset.joints)

    def _tracked(self, results: Results, name: str, each_frame: Callable[[], None]) -> Measure:
        remove_unfinished(results.recording_folder(name, self.recording))
        session = self._session()
        start = kept_start(session, self.folder)
        method = self.experiment.methods[name]
        registrar = method.bind(start.body)
        recorder = TrackRecorder(session, registrar)
        tracker = method.tracker or self.experiment.tracker
        for frame in session.tracked(registrar, tracker, start.pose):
            recorder.add(frame)
            each_frame()
        return self._recorded(results, name, session, registrar, recorder)

    def _recorded(
        self,
        results: Results,
        name: str,
        session: Session,
        registrar: Registrar,
        recorder: TrackRecorder,
    ) -> Measure:
        """All that is made of a track: its figures, its picture and its files."""
        track, body, truth = recorder.track(), registrar.body, self._truth(session)
        errors = None
        if truth is not None:
            errors = joint_errors(track, body, truth, self.experiment.dataset.joints)
        fps = session.recording.fps
        measure = measured(track, body, errors, fps)
        record = Record.of(track, recorder.snapshot, registrar, errors, truth, fps)
        results.write(name, self.recording, track, body, measure, record)
        return measure

    def _session(self) -> Session:
        """The recording with all that its frames are read from; no other one is looked at."""
        recording = self.experiment.dataset.only(self.recording)
        recording.prepare()
        return self.experiment.session(recording)

    def _truth(self, session: Session) -> Truth | None:
        """The reference joints, if there are any and they are to be compared."""
        return session.recording.truth() if self.experiment.dataset.compared else None
