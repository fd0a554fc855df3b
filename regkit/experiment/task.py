"""The unit of work: the preparation of a recording, or a method's track through it."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from glob import escape
from pathlib import Path

from regkit.experiment.experiment import Experiment
from regkit.experiment.provenance.recording import RecordingInputs, kept_inputs, prepared_inputs
from regkit.experiment.provenance.setup import Setup
from regkit.experiment.results import Results
from regkit.experiment.scenes import recorded_scene
from regkit.experiment.starts import kept_start, start_file
from regkit.interfaces import Start
from regkit.metrics import Measure, check_reference_unit, joint_errors, measured, tell_unmatched
from regkit.observation import Truth
from regkit.report import Record
from regkit.system.errors import RegkitError
from regkit.system.files import remove_unfinished
from regkit.system.optional import one_thread
from regkit.system.plugin_code import plugin_code
from regkit.tracking import Session, Snapshot, Track, TrackRecorder, smoothed

Result = Measure | RegkitError | None
"""Metrics of a track, an error, or None after the preparation of a recording."""


@dataclass(frozen=True, eq=False)
class Task:
    """A pure function of an experiment, its results folder, and the names of recording and method.

    Repeated or run elsewhere, it writes the same files to the last bit, apart from times.

    Attributes:
        experiment: The experiment; only the task's own method is needed in it.
        folder: The results folder of the experiment.
        recording: Name of the recording.
        method: Name of the method, or None to prepare the recording for all methods: read its data
            and find its start.
        setting: Name of the experiment within a sweep; empty without one.
    """

    experiment: Experiment
    folder: Path
    recording: str
    method: str | None
    setting: str = ""

    @property
    def label(self) -> str:
        """Name of the task for users."""
        who = "preparing" if self.method is None else f"{self.method} on"
        what = f"{who} {self.recording}"
        return f"{self.setting}: {what}" if self.setting else what

    def result(self, each_frame: Callable[[], None]) -> Result:
        """Runs the task.

        Args:
            each_frame: Called between two frames; only ``BaseException`` passes through from it.

        Returns:
            The metrics; errors of any kind are returned as a RegkitError.
        """
        results = Results(self.folder)
        try:
            with one_thread(), plugin_code(f"a plug-in of {self.label}"):
                Setup.of(self.experiment).check(self.folder, part=True)
                if self.method is not None:
                    return self._tracked(results, self.method, each_frame)
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
        inputs = kept_inputs(self.folder, session.recording, self.experiment.dataset)
        start = kept_start(session, self.folder, inputs.digest)
        truth = self._truth(session)
        if truth is not None:
            # Report a misspelt joint or a wrong unit before hours of computing, not after them.
            joints, place = self.experiment.dataset.joints, f"{self.recording}: reference joints"
            tell_unmatched(start.body, truth, joints, place=place)
            try:
                check_reference_unit(start.body, truth, joints)
            except RegkitError as error:
                raise error.at(place) from None

    def _tracked(self, results: Results, name: str, each_frame: Callable[[], None]) -> Measure:
        remove_unfinished(results.recording_folder(name, self.recording))
        session = self._session()
        inputs = prepared_inputs(self.folder, session.recording, self.experiment.dataset)
        with suppress(RegkitError):
            # A worker may have died after writing the files, before returning the result.
            finished = results.finished(name, self.recording, inputs.digest)
            if finished is not None:
                return finished
        start = kept_start(session, self.folder, inputs.digest)
        method = self.experiment.methods[name]
        registrar = method.bind(start.body)
        recorder = TrackRecorder(registrar, session.recording.fps, session.observation)
        tracker = method.tracker or self.experiment.tracker
        for frame in session.tracked(registrar, tracker, start.pose):
            recorder.add(frame)
            each_frame()
        return self._recorded(results, name, session, inputs, start, recorder)

    def _recorded(
        self,
        results: Results,
        name: str,
        session: Session,
        inputs: RecordingInputs,
        start: Start,
        recorder: TrackRecorder,
    ) -> Measure:
        """Computes the metrics and the scene of a track, draws its overlay and writes its files.

        Raises:
            RegkitError: If the data or the setup have changed while the recording was tracked.
        """
        body, truth = start.body, self._truth(session)
        track = recorder.track()
        if self.experiment.refine is not None:
            track = smoothed(track, body, self.experiment.refine)
        errors = None
        if truth is not None:
            errors = joint_errors(track, body, truth, self.experiment.dataset.joints)
        fps = session.recording.fps
        measure = measured(track, body, errors, fps, start)
        record = Record.of(
            track, partial(_shown, recorder, track), recorder.registrar, errors, truth, fps
        )
        scene = recorded_scene(recorder, track, record, truth, errors)
        Setup.of(self.experiment).check(self.folder, part=True)
        inputs.check(session.recording, self.experiment.dataset)
        results.write(name, self.recording, inputs.digest, track, body, measure, record, scene)
        return measure

    def _session(self) -> Session:
        """Returns the recording with everything needed to read its frames."""
        recording = self.experiment.dataset.only(self.recording)
        recording.prepare()
        return self.experiment.session(recording)

    def _truth(self, session: Session) -> Truth | None:
        """Returns the reference joints, or None if there are none to compare."""
        return session.recording.truth() if self.experiment.dataset.compared else None


def _shown(recorder: TrackRecorder, track: Track, index: int) -> Snapshot:
    """Returns a frame for pictures, in the pose of the refined track."""
    return replace(recorder.snapshot(index), pose=track.pose(index))
