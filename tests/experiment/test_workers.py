"""Whoever does the work, the figures are the same, and nothing is lost with a worker."""

import json
import os
import signal
from typing import Literal

import pytest
from small_experiment import QUICK, Stepping, add_method, figures_but_times, small

from regkit.config.plugin import register
from regkit.experiment import Experiment, run
from regkit.experiment.lock import FolderLock, locked
from regkit.experiment.workers import cluster
from regkit.experiment.workers.packed import check_worker
from regkit.interfaces import Tracker
from regkit.system.errors import DataError, DependencyError

DEADLY = '''\
import os
import signal
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from regkit.interfaces import BoundTracker, RegistrationResult, Registrar, Tracker
from regkit.config.plugin import register


@register
class Deadly(Tracker):
    """Holds the last pose, and kills its process so many times with Gaussians of three axes."""

    kind: Literal["deadly"] = "deadly"
    folder: Path
    deaths: int

    def bind(self, registrar) -> BoundTracker:
        return Dying(registrar, self)


@dataclass(frozen=True)
class Dying(BoundTracker):
    registrar: Registrar
    tracker: Deadly

    def step(self, observation, past) -> RegistrationResult:
        before = len(list(self.tracker.folder.glob("death*")))
        gsog = self.registrar.method.shape.kind == "gsog"
        if gsog and before < self.tracker.deaths:
            (self.tracker.folder / f"death{before}").touch()
            os.kill(os.getpid(), signal.SIGKILL)
        return self.registrar.register(observation, [past.last.pose])
'''


@pytest.fixture(scope="module")
def serial(tmp_path_factory):
    """The figures of two methods, worked out in one process."""
    files = small(tmp_path_factory.mktemp("serial"))
    add_method(files.experiment, "sog", "sog")
    run(Experiment.read(files.experiment), files.out, figures=False)
    return figures_but_times(files.out)


@pytest.fixture
def files(files):
    """An experiment of two methods."""
    add_method(files.experiment, "sog", "sog")
    return files


@pytest.fixture
def deadly(files, tmp_path):
    """Options by which a process is killed so many times."""
    file = tmp_path / "deadly.py"
    file.write_text(DEADLY)
    folder = tmp_path / "deaths"
    folder.mkdir()

    def options(deaths: int) -> tuple[object, ...]:
        tracker = f"{{kind: deadly, folder: {folder}, deaths: {deaths}}}"
        return ("--plugin", file, "--set", f"tracker={tracker}")

    return options


@pytest.mark.long
def test_figures_of_two_processes_are_those_of_one(regkit, files, serial):
    ended = regkit("run", files.experiment, "--out", files.out, "--no-figures", "--jobs", 2)
    assert ended.code == 0, ended.err
    # So few steps of a solver do not find the body surely.
    assert all("doubtful" in line for line in ended.err.splitlines()), ended.err
    assert figures_but_times(files.out) == serial
    environment = json.loads((files.out / "environment.json").read_text())
    assert environment["workers"] == ["2 processes"]
    assert not list(files.out.rglob(".*"))


NOTING = '''\
from typing import Literal

from regkit.config.plugin import register
from regkit.interfaces import BoundTracker, Registrar, Tracker
from regkit.system.notes import note
from regkit_plugins.trackers.constant_pose import ConstantPose


@register
class Noting(Tracker):
    """Holds the last pose, and tells it."""

    kind: Literal["noting"] = "noting"

    def bind(self, registrar: Registrar) -> BoundTracker:
        note("the tracker is that of a test")
        return ConstantPose().bind(registrar)
'''


@pytest.mark.parametrize("jobs", [1, 2])
def test_what_every_worker_notes_is_told_once(regkit, files, tmp_path, jobs):
    file = tmp_path / "noting.py"
    file.write_text(NOTING)
    options = ("--plugin", file, "--set", "tracker=noting", "--jobs", jobs, *QUICK)
    ended = regkit("run", files.experiment, "--out", files.out, "--no-figures", *options)
    assert ended.code == 0, ended.err
    assert ended.err.count("the tracker is that of a test") == 1


@pytest.mark.long
def test_killed_process_loses_nothing(regkit, files, serial, deadly):
    ended = regkit(
        "run", files.experiment, "--out", files.out, "--no-figures", "--jobs", 2, *deadly(1)
    )
    assert ended.code == 0
    assert "failed" not in ended.err
    assert figures_but_times(files.out) == serial


@pytest.mark.long
def test_track_that_kills_every_process_fails_alone(regkit, files, deadly):
    ended = regkit("run", files.experiment, "--out", files.out, "--jobs", 2, *QUICK, *deadly(99))
    assert ended.code == 1
    assert "gsog on first failed: its process died 3 times" in ended.err
    assert "its process died" in files.metrics()["gsog"]["recordings"]["first"]["error"]
    assert files.metrics()["sog"]["recordings"]["first"]["frames"] == 1


@pytest.mark.long
def test_figures_of_a_dask_cluster_are_those_of_one_process(regkit, files, serial, deadly):
    """Two workers; one of them is killed in its work, and a new one takes its place."""
    from distributed import LocalCluster

    with LocalCluster(
        n_workers=2, threads_per_worker=2, dashboard_address="127.0.0.1:0", silence_logs=50
    ) as dask:
        scheme = f"dask:{dask.scheduler_address}"
        options = ("--cluster", scheme, "--no-figures", *deadly(1))
        ended = regkit("run", files.experiment, "--out", files.out, *options)
        assert ended.code == 0, ended.err
        assert all("doubtful" in line for line in ended.err.splitlines()), ended.err
        assert figures_but_times(files.out) == serial


def test_plug_in_that_workers_do_not_know_is_refused(regkit, files):
    @register
    class Own(Tracker):
        """Known in this process only."""

        kind: Literal["own"] = "own"

        def bind(self, registrar):
            return Stepping(registrar, lambda: None)

    options = ("--set", "tracker=own", "--jobs", 2)
    ended = regkit("run", files.experiment, "--out", files.out, *options)
    assert ended.code == 1
    assert "the plug-in 'own' was registered in this process" in ended.err
    assert not files.out.exists()


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        (("--cluster", "ray:auto"), "--cluster ray:auto: a cluster is given as "
         "SCHEME:ADDRESS"),
        (("--cluster", "dask:tcp://127.0.0.1:1", "--jobs", 2), "a cluster has its own workers"),
        (("--cluster", "dask:nowhere"), "there is no Dask scheduler: missing port number"),
        (("--cluster", "dask:tcp://127.0.0.1:1"), "there is no Dask scheduler: Timed out"),
    ],
)  # fmt: skip
def test_cluster_that_cannot_be_had_is_told(regkit, files, monkeypatch, options, expected):
    monkeypatch.setattr(cluster, "REACHED_WITHIN", 1.0)
    ended = regkit("run", files.experiment, "--out", files.out, *options)
    assert ended.code == 1
    assert expected in ended.err
    assert not files.out.exists()


def test_worker_that_cannot_serve_says_why(tmp_path):
    from regkit import __version__

    with locked(tmp_path / "out") as lock:
        check_worker(lock, __version__)
        with pytest.raises(DependencyError, match="and the run has 99"):
            check_worker(lock, "99")
        # The same path without a shared file system, or another run in the folder.
        with pytest.raises(DataError, match="does not see the results folder"):
            check_worker(FolderLock(tmp_path / "elsewhere", lock.run), __version__)
        with pytest.raises(DataError, match="does not see the results folder"):
            check_worker(FolderLock(lock.folder, "another"), __version__)
    assert not (tmp_path / "out").exists()


@pytest.mark.long
def test_interrupt_ends_the_processes_and_the_run_is_completed_later(
    regkit, files, serial, started
):
    """Ctrl-C, as a terminal sends it: to the run and all of its processes."""
    begun = started("run", files.experiment, "--out", files.out, "--no-figures", "--jobs", 2)
    begun.wait_for(files.out / "environment.json")
    os.killpg(begun.process.pid, signal.SIGINT)
    told = begun.process.communicate(timeout=60)[1]
    assert begun.process.returncode == 130
    assert told.splitlines() == [
        "stopping; press Ctrl-C again to end at once",
        f"interrupted; finished work is kept: continue with --out {files.out}",
    ]
    assert regkit("run", files.experiment, "--out", files.out, "--no-figures").code == 0
    assert figures_but_times(files.out) == serial
