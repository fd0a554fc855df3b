"""A run that is begun again does what is missing, and nothing is lost."""

import errno
import os
import signal
import sys
from typing import Literal

import pytest
from messages import tells
from small_experiment import (
    FRAMES,
    QUICK,
    Stepping,
    add_method,
    counting,
    damage,
    figures_but_times,
)

from regkit.config.plugin import register
from regkit.experiment import Experiment
from regkit.experiment.ledger import Ledger
from regkit.experiment.lock import locked
from regkit.experiment.results import Results
from regkit.experiment.task import Task
from regkit.interfaces import BoundTracker, Tracker
from regkit.system.errors import DataError


def test_finished_run_does_nothing_again(regkit, files):
    steps = counting()
    arguments = (
        "run",
        files.experiment,
        "--out",
        files.out,
        "--no-figures",
        "--set",
        "tracker=counting",
    )
    assert regkit(*arguments).code == 0
    # A step in which loops are loaded is repeated.
    done = len(steps)
    assert done >= 2 * FRAMES
    before, metrics = files.written(), files.metrics()
    assert regkit(*arguments).code == 0
    assert len(steps) == done
    assert files.written() == before
    assert files.metrics() == metrics


def test_resumed_run_does_only_what_is_missing(regkit, files):
    steps = counting()
    arguments = (
        "run",
        files.experiment,
        "--out",
        files.out,
        "--no-figures",
        "--set",
        "tracker=counting",
    )
    regkit(*arguments)
    before, metrics = files.written(), files.metrics()
    (files.out / "gsog" / "second" / "checksums.json").unlink()
    steps.clear()
    assert regkit(*arguments).code == 0
    assert steps == FRAMES * ["GeneralizedSumOfGaussians"]
    after = files.written()
    changed = {name for name, when in after.items() if before[name] != when}
    assert changed == {
        "gsog/second/checksums.json",
        "gsog/second/measure.json",
        "gsog/second/poses.npz",
        "gsog/second/record.npz",
        "gsog/second/scene.npz",
        "gsog/second/overlay.png",
    }
    for method, figures in files.metrics().items():
        for name in ("joint_error_raw_cm", "evaluations_per_frame"):
            assert figures["mean"][name] == metrics[method]["mean"][name]


def raised() -> None:
    raise KeyboardInterrupt


def pressed() -> None:
    """Ctrl-C, as a terminal sends it."""
    os.kill(os.getpid(), signal.SIGINT)


@pytest.mark.parametrize("interrupt", [raised, pressed])
def test_interrupted_run_is_completed_later(regkit, files, interrupt):
    """What is finished when the user interrupts is kept, and the rest is done the next time."""
    steps = counting()

    @register
    class Impatient(Tracker):
        """Is interrupted in the second recording, once."""

        kind: Literal["impatient"] = "impatient"

        def bind(self, registrar) -> BoundTracker:
            def grow_impatient() -> None:
                steps.append("")
                if len(steps) == FRAMES + 2:
                    interrupt()

            return Stepping(registrar, grow_impatient)

    arguments = (
        "run",
        files.experiment,
        "--out",
        files.out,
        "--no-figures",
        "--set",
        "tracker=impatient",
    )
    ended = regkit(*arguments)
    assert ended.code == 130
    assert ended.err.endswith(
        f"interrupted; finished work is kept: continue with --out {files.out}\n"
    )
    assert {name.rsplit("/", 1)[0] for name in files.written()} == {"gsog/first"}
    begun = len(steps)
    assert regkit(*arguments).code == 0
    assert len(steps) - begun == FRAMES
    assert len(files.written()) == 12


@pytest.mark.long
@pytest.mark.filterwarnings("default::regkit.system.notes.RegkitWarning")
def test_damaged_measure_is_told_and_made_again_and_the_rest_is_kept(regkit, files):
    regkit("run", files.experiment, "--out", files.out, "--no-figures")
    before, figures = files.written(), figures_but_times(files.out)
    damaged = files.out / "gsog" / "first" / "measure.json"
    damaged.write_text("{")
    ended = regkit("run", files.experiment, "--out", files.out, "--no-figures")
    assert ended.code == 0
    assert f"warning: {damaged}: damaged" in ended.err
    assert figures_but_times(files.out) == figures
    kept = {name for name, when in files.written().items() if before[name] == when}
    assert {name.split("/")[1] for name in kept} == {"second"}


def test_folder_of_another_configuration_is_refused(regkit, files):
    regkit("run", files.experiment, "--out", files.out, *QUICK)
    before = files.written()
    ended = regkit(
        "run",
        files.experiment,
        "--out",
        files.out,
        "--no-figures",
        "--set",
        "methods.gsog.solver.memory=3",
    )
    assert ended.code == 1
    assert tells(ended.err, at=f"{files.out}", of="another configuration")
    assert files.written() == before


def test_folder_with_other_files_is_refused_and_left_alone(regkit, files):
    files.out.mkdir()
    (files.out / "thesis.tex").write_text("precious")
    ended = regkit("run", files.experiment, "--out", files.out, "--no-figures")
    assert ended.code == 1
    assert tells(ended.err, at=f"{files.out}", of=("other files", "new", "empty"))
    assert [path.name for path in files.out.iterdir()] == ["thesis.tex"]


def test_users_own_configuration_with_other_files_is_no_results_folder(regkit, files):
    """The name ``config.yaml`` is a common one."""
    assert regkit("run", files.experiment, "--out", files.out, *QUICK).code == 0
    project = files.out.with_name("project")
    project.mkdir()
    (project / "config.yaml").write_text((files.out / "config.yaml").read_text())
    (project / "thesis.tex").write_text("precious")
    ended = regkit("run", project / "config.yaml", "--out", project, "--no-figures")
    assert ended.code == 1
    assert tells(ended.err, at=f"{project}", of=("other files", "new", "empty"))
    assert len(list(project.iterdir())) == 2


@pytest.mark.long
def test_run_that_was_killed_while_it_opened_its_folder_begins_anew(regkit, files):
    assert regkit("run", files.experiment, "--out", files.out, *QUICK).code == 0
    for kept in (("config.yaml",), ("config.yaml", "setup.json")):
        left = files.out.with_name("-".join(kept))
        left.mkdir()
        for name in kept:
            (left / name).write_text((files.out / name).read_text())
        (left / ".setup.json.0.tmp.json").touch()
        assert regkit("run", files.experiment, "--out", left, *QUICK).code == 0
        assert not list(left.rglob(".*"))


def test_only_keeps_what_other_methods_have_finished(regkit, files):
    add_method(files.experiment, "sog", "sog")
    assert regkit("run", files.experiment, "--out", files.out, *QUICK).code == 0
    before = files.metrics()
    (files.out / "sog" / "first" / "checksums.json").unlink()
    assert regkit("run", files.experiment, "--out", files.out, "--only", "sog", *QUICK).code == 0
    assert files.metrics()["gsog"] == before["gsog"]
    assert set(files.metrics()["sog"]["recordings"]) == {"first"}


def test_only_keeps_what_other_methods_have_failed(regkit, files):
    add_method(files.experiment, "sog", "sog")
    damage(files.data / "second" / "depth" / "000000.png")
    assert regkit("run", files.experiment, "--out", files.out, "--no-figures").code == 1
    before = files.metrics()
    only = ("--only", "sog", "--no-figures")
    assert regkit("run", files.experiment, "--out", files.out, *only).code == 1
    assert "000000.png" in before["gsog"]["recordings"]["second"]["error"]
    assert files.metrics()["gsog"] == before["gsog"]


def test_comment_in_the_folders_configuration_is_no_difference(regkit, files):
    assert regkit("run", files.experiment, "--out", files.out, *QUICK).code == 0
    with (files.out / "config.yaml").open("a") as stream:
        stream.write("# Looked at on Monday.\n")
    assert regkit("run", files.experiment, "--out", files.out, *QUICK).code == 0


def test_what_a_kill_left_of_a_report_is_removed(regkit, files):
    assert regkit("run", files.experiment, "--out", files.out, *QUICK).code == 0
    for name in ("figures/.bars.png.0.tmp.png", "tables/.pairs.csv.0.tmp.csv", ".a.json.0.tmp"):
        (files.out / name).parent.mkdir(exist_ok=True)
        (files.out / name).touch()
    assert regkit("run", files.experiment, "--out", files.out, *QUICK).code == 0
    assert not list(files.out.rglob(".*"))


def test_difference_to_the_folder_is_named(regkit, files):
    regkit("run", files.experiment, "--out", files.out, *QUICK)
    ended = regkit("run", files.experiment, "--out", files.out, "--no-figures", "--set",
                   "preprocessor=octree", *QUICK)  # fmt: skip
    assert "preprocessor.kind is points there and octree here" in ended.err


def test_killed_run_is_completed_later(regkit, files, started):
    """Killed as hard as can be, while a track is half done and another is finished."""
    whole = files.out.with_name("whole")
    add_method(files.experiment, "sog", "sog")
    assert regkit("run", files.experiment, "--out", whole, "--no-figures").code == 0
    run = started("run", files.experiment, "--out", files.out, "--no-figures")
    run.wait_for(files.out / "gsog" / "first" / "checksums.json")
    run.process.send_signal(signal.SIGKILL)
    run.process.wait()
    left = files.out / "sog" / "first" / ".poses.npz.0.tmp.npz"
    left.parent.mkdir(parents=True, exist_ok=True)
    left.touch()
    before = files.written()
    assert regkit("run", files.experiment, "--out", files.out, "--no-figures").code == 0
    kept = {name: when for name, when in before.items() if name.startswith("gsog/first")}
    assert kept == {name: when for name, when in files.written().items() if name in kept}
    assert figures_but_times(files.out) == figures_but_times(whole)
    assert not list(files.out.rglob(".*"))


def test_two_runs_in_one_folder_are_refused(regkit, files):
    with locked(files.out):
        ended = regkit("run", files.experiment, "--out", files.out, "--no-figures")
        assert ended.code == 1
        assert f"another run (process {os.getpid()} on " in ended.err
        assert "writes to this folder" in ended.err
    assert regkit("run", files.experiment, "--out", files.out, *QUICK).code == 0


def test_folder_that_cannot_be_claimed_is_told(files, monkeypatch):
    def full(descriptor: int, data: bytes) -> int:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "write", full)
    with pytest.raises(DataError, match="cannot be written: No space left"), locked(files.out):
        pass
    assert not files.out.exists()


@pytest.mark.skipif(sys.platform == "win32", reason="locks are others there")
def test_file_system_without_locks_is_not_another_run(files, monkeypatch):
    def unknown(descriptor: int, operation: int) -> None:
        raise OSError(errno.ENOLCK, "No locks available")

    monkeypatch.setattr("fcntl.flock", unknown)
    with pytest.raises(DataError, match="No locks available"), locked(files.out):
        pass


def test_writing_the_figures_takes_little_of_a_runs_time(files, monkeypatch):
    """Of a large sweep it takes seconds, and may not be done after each track."""
    experiment, now, written = Experiment.read(files.experiment), [100.0], []

    def slow(*_: object) -> None:
        written.append(now[0])
        now[0] += 3.0

    monkeypatch.setattr("regkit.experiment.ledger.summarise", slow)
    monkeypatch.setattr("regkit.experiment.ledger.time.monotonic", lambda: now[0])
    recordings = {"first": experiment.dataset.only("first")}
    ledger = Ledger(experiment, Results(files.out), ["gsog"], recordings)
    task = Task(experiment, files.out, "first", "gsog")
    for _ in range(300):
        now[0] += 2.0
        ledger.ended(task, DataError("it is dark"))
    assert len(written) > 1
    assert 3.0 * len(written) < 0.07 * (now[0] - 100.0)


@pytest.mark.long
@pytest.mark.filterwarnings("default::regkit.system.notes.RegkitWarning")
def test_start_is_found_once(regkit, files):
    """A resumed run and other methods begin where the first one did, to the last bit."""
    files.experiment.write_text(
        "".join(line for line in files.experiment.read_text().splitlines(keepends=True)
                if not line.startswith("start:"))
    )  # fmt: skip
    arguments = ("run", files.experiment, "--out", files.out, *QUICK)
    assert regkit(*arguments).code == 0
    kept = files.out / "starts" / "first.json"
    when, first = kept.stat().st_mtime_ns, figures_but_times(files.out)
    (files.out / "gsog" / "first" / "checksums.json").unlink()
    assert regkit(*arguments).code == 0
    assert kept.stat().st_mtime_ns == when
    assert figures_but_times(files.out) == first
    text = kept.read_text()
    for damaged in ("{", text.replace("0.", "1.", 1)):
        (files.out / "gsog" / "first" / "checksums.json").unlink()
        kept.write_text(damaged)
        ended = regkit(*arguments)
        assert ended.code == 0
        assert f"warning: {kept}: " in ended.err
        assert kept.read_text() == text
        assert figures_but_times(files.out) == first
