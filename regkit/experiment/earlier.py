"""Results of earlier starts of a run: which of them still count, and what is told of the others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from regkit.experiment.experiment import Experiment
from regkit.experiment.opening import another_configuration
from regkit.experiment.provenance.recording import RecordingInputs, inputs_file
from regkit.experiment.results import Results
from regkit.experiment.starts import start_file
from regkit.interfaces import Recording
from regkit.metrics import Measure
from regkit.system.errors import RegkitError
from regkit.system.notes import note


@dataclass(frozen=True)
class EarlierResults:
    """The tracks in an experiment's folder, compared with the recordings as they are now.

    Attributes:
        experiment: The experiment.
        results: Its results folder.
        methods: Names of the methods in this run.
        moved: Paths that differ from those of an earlier start of the run, in a few words.
    """

    experiment: Experiment
    results: Results
    methods: Sequence[str]
    moved: str
    _contents: dict[str, RecordingInputs] = field(default_factory=dict)

    def failures(self) -> dict[str, dict[str, str]]:
        """Returns reasons of earlier failures by method and recording."""
        try:
            return self.results.failures()
        except RegkitError as error:
            note(f"{error.message}; it is written again", place=error.place)
            return {}

    def measures(self, recording: Recording) -> dict[str, Measure]:
        """Returns the metrics of the finished tracks on a recording, by method.

        Damaged tracks, and those of other content of the recording, are told and not finished.

        Raises:
            ConfigError: If paths in the configuration differ, and the content there too.
        """
        inputs = self._inputs(recording)
        if inputs is None:
            return {}
        found = {method: self._finished(method, recording.name, inputs)
                 for method in self.experiment.methods}  # fmt: skip
        return {method: measure for method, measure in found.items() if measure is not None}

    def keep(self) -> None:
        """Writes the recordings' content as it is now."""
        for name, inputs in self._contents.items():
            inputs.write(inputs_file(self.results.folder, name))

    def tell_others(self, recordings: Sequence[str]) -> None:
        """Tells of results on recordings that the dataset does not have any more."""
        names = [file.stem for file in (self.results.folder / "inputs").glob("*.json")]
        for name in sorted(set(names) - set(recordings)):
            note(
                f"{name} is not among the recordings any more; this run leaves out "
                "the results on it",
                place=self.results.folder,
            )

    def _inputs(self, recording: Recording) -> str | None:
        """Returns the digest of a recording's content, or None if there is no result on it."""
        folder, name = self.results.folder, recording.name
        begun = [method for method in self.experiment.methods if self.results.begun(method, name)]
        if not begun and not start_file(folder, name).exists():
            return None
        file = inputs_file(folder, name)
        known = RecordingInputs.known(file)
        try:
            now = RecordingInputs.of(recording, self.experiment.dataset, known)
        except RegkitError:
            return None  # The preparation of the recording reports it.
        if known is None:
            note("missing or damaged; only results on the present data are kept", place=file)
        elif known.digest != now.digest:
            what = f"{name} has changed: {known.changes(now)}"
            if self.moved:
                raise another_configuration(f"{self.moved}, and {what}", folder)
            note(f"{what}; results on it are {self._again(begun)}", place=folder)
        if known != now:
            self._contents[name] = now
        return now.digest

    def _finished(self, method: str, recording: str, inputs: str) -> Measure | None:
        try:
            return self.results.finished(method, recording, inputs)
        except RegkitError as error:
            what = error.message.partition(";")[0]
            note(f"{what}; the track is {self._again([method])}", place=error.place)
            return None

    def _again(self, methods: Sequence[str]) -> str:
        """Returns the words for what becomes of results that are not used."""
        others = [method for method in methods if method not in self.methods]
        left_out = f", and left out for {', '.join(others)}, which this run does not include"
        return f"made again{left_out if others else ''}"
