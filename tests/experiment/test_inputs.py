"""Results belong to their inputs: what has changed is done again or refused, never mixed."""

import json
import os
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Literal

import numpy as np
import pytest
from messages import tells
from small_experiment import Files, add_method, copy_recording, small

from regkit.config.model import InputPath
from regkit.config.plugin import register
from regkit.config.registry import run_plugin_file
from regkit.experiment import Experiment, run
from regkit.experiment.ledger import Ledger
from regkit.experiment.provenance import code
from regkit.experiment.provenance.recording import RecordingInputs
from regkit.experiment.provenance.setup import Setup
from regkit.experiment.reporting import found
from regkit.experiment.results import Results
from regkit.experiment.task import Task
from regkit.interfaces import Dataset, Recording, Tracker
from regkit.system import digests
from regkit.system.errors import ConfigError, DataError
from regkit.system.notes import RegkitWarning

SETTINGS = ("dataset.frames=1", "tracker=constant_pose")
TRACKS = {("gsog", "first"), ("gsog", "second")}


@pytest.fixture(scope="module")
def done(tmp_path_factory) -> Files:
    files = small(tmp_path_factory.mktemp("bound"))
    run(Experiment.read(files.experiment, SETTINGS), files.out, figures=False)
    return files


@pytest.fixture
def files(done, tmp_path) -> Files:
    """A copy of the experiment, its data and its results in another place."""
    shutil.copytree(done.experiment.parent, tmp_path / "copy")
    return Files(*(tmp_path / "copy" / path.name for path in done))


def ledger(files: Files, *settings: str, only: tuple[str, ...] = ()) -> Ledger:
    """The state of a resumed run before its work begins."""
    experiment = Experiment.read(files.experiment, [*SETTINGS, *settings])
    recordings = {one.name: one for one in experiment.dataset.chosen()}
    methods = list(only or experiment.methods)
    one = Ledger(experiment, Results(files.out), methods, recordings)
    one.read(one.opening.check())
    return one


def finished(state: Ledger) -> set[tuple[str, str]]:
    return {(method, name) for method, by in state.outcome.measures.items() for name in by}


def rewritten(name: str, old: str, new: str) -> Callable[[Path], None]:
    def act(folder: Path) -> None:
        text = (folder / name).read_text()
        assert old in text
        (folder / name).write_text(text.replace(old, new, 1))

    return act


def same_size_and_time(folder: Path) -> None:
    """The content changes, and the size and the time of the change are put back."""
    image = folder / "depth" / "000000.png"
    before, content = image.stat(), bytearray(image.read_bytes())
    content[-20] ^= 1
    image.write_bytes(content)
    os.utime(image, ns=(before.st_atime_ns, before.st_mtime_ns))


CHANGES = {
    "image": lambda folder: shutil.copy(folder / "depth/000001.png", folder / "depth/000000.png"),
    "image of the same size and time": same_size_and_time,
    "camera": rewritten("camera.json", "176", "176.0"),
    "scale": rewritten("sequence.yaml", "\n", "\ndepth_scale: 999\n"),
    "rate": rewritten("sequence.yaml", "\n", "\nfps: 15\n"),
    "truth": rewritten("truth.csv", "head", "Head"),
    "truth gone": lambda folder: (folder / "truth.csv").unlink(),
}


@pytest.mark.long
def test_results_that_were_copied_with_their_data_are_finished(files):
    """Neither another place nor other times are a change; nothing is told."""
    assert finished(ledger(files)) == TRACKS
    for path in files.data.rglob("*.png"):
        path.touch()
    assert finished(ledger(files)) == TRACKS


@pytest.mark.parametrize("change", CHANGES)
def test_changed_recording_is_told_and_not_finished(done, tmp_path, monkeypatch, change):
    shutil.copytree(done.experiment.parent, tmp_path / "copy")
    files = Files(*(tmp_path / "copy" / path.name for path in done))
    # In its place: the configuration is the same, and only the content is another.
    config = files.out / "config.yaml"
    config.write_text(config.read_text().replace(str(done.data), str(files.data)))
    CHANGES[change](files.data / "first")
    with pytest.warns(RegkitWarning, match="first has changed"):
        state = ledger(files)
    assert finished(state) == {("gsog", "second")}
    assert [task.recording for task, _ in state.tracks()] == ["first"]
    assert not state.outcome.failures["gsog"]


def test_other_data_in_another_place_are_another_configuration(files):
    CHANGES["scale"](files.data / "second")
    before = {path: path.read_bytes() for path in files.out.rglob("*.json")}
    with pytest.raises(ConfigError, match=r"dataset.root is .* second has changed: sequence.yaml"):
        ledger(files)
    assert {path: path.read_bytes() for path in files.out.rglob("*.json")} == before


def test_unchanged_files_are_not_read_again(files, monkeypatch):
    read = []
    monkeypatch.setattr(digests, "_digest", lambda path: read.append(path) or "")
    digests._remembered.cache_clear()
    experiment = Experiment.read(files.experiment, SETTINGS)
    recording = experiment.dataset.only("first")
    known = RecordingInputs.of(recording, experiment.dataset)
    assert len(read) == 4
    again = RecordingInputs.of(recording, experiment.dataset, known)
    assert (len(read), again.digest) == (4, known.digest)


def test_changed_recording_is_done_again_by_all_methods(regkit, tmp_path, monkeypatch):
    """With ``--only`` the others are left out until they are run, also by the report."""
    files = small(tmp_path)
    add_method(files.experiment, "sog", "sog")
    arguments = ("run", files.experiment, "--out", files.out, "--no-figures",
                 "--set", "dataset.frames=1")  # fmt: skip
    assert regkit(*arguments).code == 0
    raw = files.metrics()["gsog"]["recordings"]["first"]["joint_error_raw_cm"]
    rewritten("sequence.yaml", "\n", "\ndepth_scale: 990\n")(files.data / "first")
    monkeypatch.setattr("warnings.filters", [])
    ended = regkit(*arguments, "--only", "sog")
    assert ended.code == 0
    assert tells(ended.err, at=f"warning: {files.out}: first", of=("sequence.yaml", "gsog"))
    assert set(files.metrics()["gsog"]["recordings"]) == {"second"}
    assert set(files.metrics()["sog"]["recordings"]) == {"first", "second"}
    with pytest.warns(RegkitWarning, match="gsog tracked first before its data changed"):
        measures, _ = found(files.out)
    assert [set(by) for by in measures.values()] == [{"second"}, {"first", "second"}]
    assert regkit(*arguments).code == 0
    assert files.metrics()["gsog"]["recordings"]["first"]["joint_error_raw_cm"] != raw
    measures, _ = found(files.out)
    assert [set(by) for by in measures.values()] == 2 * [{"first", "second"}]


def test_data_that_change_during_the_run_are_told(files):
    """A method is not compared with another one on other data."""
    state = ledger(files)
    task = Task(state.experiment, files.out, "first", "gsog")
    (files.out / "gsog" / "first" / "checksums.json").unlink()
    CHANGES["scale"](files.data / "first")
    result = task.result(lambda: None)
    assert isinstance(result, DataError)
    assert "changed during the run: sequence.yaml" in str(result)


TEMPLATE = """\
title: a rod
size: {name: length, value: 1.7, range: [1, 2]}
segments:
  rod:
    joint: {type: free}
    markers: {head: [0, 0.8, 0], pelvis: [0, 0, 0]}
    capsules: [{start: [0, -0.8, 0], end: [0, 0.8, 0], radius: 0.1}]
"""


def test_setup_names_what_has_changed(tmp_path, files):
    """Template, plug-in file, the code of a package, and the version of a library."""
    plugin, rod = tmp_path / "own.py", tmp_path / "rod.yaml"
    weights = tmp_path / "weights.bin"
    weights.write_bytes(b"1")
    rod.write_text(TEMPLATE)
    text = (
        "from typing import Literal\nfrom regkit.config.model import InputPath\n"
        "from regkit.config.plugin import register\nfrom regkit.interfaces import Tracker\n\n"
        '@register\nclass Own(Tracker):\n    kind: Literal["own"] = "own"\n    weights: InputPath\n'
        "    def bind(self, registrar):\n        return None\n"
    )
    plugin.write_text(text)
    run_plugin_file(plugin)
    settings = (f"template={{kind: file, path: {rod}}}", "start=exemplars",
                f"tracker={{kind: own, weights: {weights}}}")  # fmt: skip

    def setup() -> Setup:
        return Setup.of(Experiment.read(files.experiment, settings))

    before = setup()
    assert {"regkit", "numpy", "scipy", "numba", "casadi"} <= before.versions.keys()
    assert before.versions["numpy"] == np.__version__
    assert {"regkit", "regkit_plugins"} <= before.code.keys()
    before.write(tmp_path)
    before.check(tmp_path)
    for file, new, names in (
        (rod, TEMPLATE.replace("0.1}", "0.2}"), ("template: rod.yaml", "radius")),
        (weights, "2", ("tracker: weights.bin",)),
        (plugin, text + "# changed\n", ("the code of own.py",)),
    ):
        old = file.read_text()
        file.write_text(new)
        with pytest.raises(ConfigError) as caught:
            setup().check(tmp_path)
        assert tells(str(caught.value), at=str(tmp_path), of=(*names, "another setup"))
        file.write_text(old)
    setup().check(tmp_path)
    stored = json.loads((tmp_path / "setup.json").read_text())
    stored["versions"]["numpy"] = "1.0"
    del stored["versions"]["scipy"]
    (tmp_path / "setup.json").write_text(json.dumps(stored))
    with pytest.raises(ConfigError, match=r"numpy is 1.0 there .* scipy is not installed there"):
        setup().check(tmp_path)


def test_changed_setup_is_refused_and_the_results_are_left(regkit, tmp_path):
    files = small(tmp_path)
    rod = tmp_path / "rod.yaml"
    rod.write_text(TEMPLATE)
    arguments = ("run", files.experiment, "--out", files.out, "--no-figures", "--set",
                 "dataset.frames=1", "--set", f"template={{kind: file, path: {rod}}}",
                 "--set", "template.size=1.7")  # fmt: skip
    assert regkit(*arguments).code == 0
    before = {path: path.stat().st_mtime_ns for path in files.out.rglob("*")}
    rod.write_text(TEMPLATE.replace("radius: 0.1", "radius: 0.11"))
    ended = regkit(*arguments)
    assert ended.code == 1
    assert tells(ended.err, at=f"{files.out}: ", of=("template: rod.yaml", "0.11"))
    assert {path: path.stat().st_mtime_ns for path in files.out.rglob("*")} == before
    rod.write_text(TEMPLATE)
    assert regkit(*arguments).code == 0
    # A worker with other libraries does no work.
    experiment = Experiment.read(files.experiment, [one for one in arguments if "=" in str(one)])
    stored = json.loads((files.out / "setup.json").read_text())
    stored["versions"]["numpy"] = "1.0"
    (files.out / "setup.json").write_text(json.dumps(stored))
    result = Task(experiment, files.out, "first", "gsog").result(lambda: None)
    assert "numpy is 1.0 there" in str(result)


def test_dataset_of_a_third_party_is_bound_by_the_paths_that_it_names(tmp_path):
    """All files in its folders, but for results that lie there."""

    class Own(Dataset):
        kind: Literal["own"] = "own"
        root: Path

        def found(self) -> list[Recording]:
            return []

    class Computed(Recording):
        def frames(self):
            return iter(())

        def truth(self):
            return None

    (tmp_path / "data").mkdir()
    file = tmp_path / "data" / "take.bin"
    file.write_bytes(b"1")
    results = tmp_path / "data" / "results" / "out"
    results.mkdir(parents=True)
    dataset, recording = Own(root=tmp_path), Computed("take", 30.0, 1)
    before = RecordingInputs.of(recording, dataset)
    assert list(before.files) == ["take.bin"]
    for name in ("config.yaml", "environment.json"):
        (results / name).write_text("{}")
    assert RecordingInputs.of(recording, dataset).digest == before.digest
    (tmp_path / "data" / "circle").symlink_to(tmp_path, target_is_directory=True)
    assert RecordingInputs.of(recording, dataset).digest == before.digest
    file.write_bytes(b"2")
    now = RecordingInputs.of(recording, dataset)
    assert now.digest != before.digest
    assert before.changes(now) == "take.bin has changed"
    longer = RecordingInputs.of(Computed("take", 30.0, 2), dataset)
    assert now.changes(longer) == "length was 1 and is 2"


def test_plug_in_reads_the_paths_that_are_marked_as_input(tmp_path):
    class Own(Tracker):
        kind: Literal["own"] = "own"
        weights: dict[str, InputPath | None]
        log: Path

        def bind(self, registrar):
            raise NotImplementedError

    own = register(Own)(weights={"a": "w.bin", "b": None}, log="out.txt")
    assert list(own.input_files()) == [Path("w.bin").absolute()]
    assert [name for name in code.code([own]) if "Own" in name] == [
        f"test_inputs.py: {Own.__qualname__}"
    ]


def test_synthetic_recording_is_bound_to_what_is_rendered():
    data = {"kind": "synthetic", "takes": {"walk": {"motion": "walk", "frames": 2}}}
    changed = {**data, "takes": {"walk": {**data["takes"]["walk"], "noise": 0.01}}}
    first, again, other = (
        Dataset.parse(one, place="test", field="dataset").only() for one in (data, data, changed)
    )
    assert first.fingerprint() == again.fingerprint() != other.fingerprint()
    assert list(first.input_files()) == []


def test_recording_of_another_folder_is_not_taken_for_the_first(tmp_path):
    """Names of files do not depend on where the folder is."""
    for name in ("a", "b"):
        copy_recording(tmp_path / name / "take")
    digests_of = [
        RecordingInputs.of(dataset.only(), dataset).digest
        for name in ("a", "b")
        for dataset in [Dataset.parse({"kind": "depth", "root": str(tmp_path / name)},
                                      place="test", field="dataset")]
    ]  # fmt: skip
    assert digests_of[0] == digests_of[1]
