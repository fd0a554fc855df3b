"""Damaged inputs and YAML bring a RegkitError, or what can be right."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from places import ROOT

from regkit.system.errors import DataError
from regkit.system.notes import note
from tests.fuzz import trial
from tests.fuzz.case import Case, drawn
from tests.fuzz.kind import Kind
from tests.fuzz.seeds import GROUPS, seeds_of
from tests.fuzz.trial import Outcome, tried
from tests.fuzz.workers import Worker

KINDS = [(group, kind) for group, kinds in GROUPS.items() for kind in kinds]
COSTLY = ("results/", "datasets/itop")
"""Kinds that only ``make fuzz`` tries: the files take seconds to make."""
CASES = 10
"""Number of cases of a block in ``make test``."""


def cheap(group: str, numbers: range) -> list[Case]:
    # The files are made with the case, so the kind is asked for first.
    kept = (n for n in numbers if not drawn(group, 0, n)[1].name.startswith(COSTLY))
    return [Case.of(group, 0, number) for number in kept]


def sound(kind: Kind, group: str, number: int = 0) -> Case:
    files = seeds_of(group, kind.name)[number]
    name = next(name for name in kind.forms if name in files)
    return Case(group, number, kind, files, name, files[name], name, ())


@pytest.mark.parametrize("block", range(9))
@pytest.mark.parametrize("group", GROUPS)
def test_damage_is_refused_or_harmless(group, block):
    cases = cheap(group, range(CASES * block, CASES * (block + 1)))
    failures = [f"{case.place}: {outcome}" for case in cases if (outcome := tried(case)).failed]
    assert not failures, "\n".join(failures)


@pytest.mark.long
def test_damaged_results_are_refused_or_harmless(tmp_path):
    """In a process of its own, as ``make fuzz`` does it; the last line has the figures."""
    options = ("--inputs", "600", "--kind", "results/", "--keep", str(tmp_path / "kept"))
    command = [sys.executable, "-m", "tests.fuzz", *options]
    ended = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    figures = json.loads(ended.stdout.splitlines()[-1])
    assert figures["inputs"]["cases"] > 10
    assert ended.returncode == 0, ended.stdout


@pytest.mark.parametrize(("group", "kind"), [pytest.param(*one, id=one[1].name) for one in KINDS])
def test_what_is_sound_is_accepted(group, kind):
    """Else its damage would be refused for the wrong reason."""
    if kind.name.startswith(COSTLY):
        pytest.skip("its files take seconds to make")
    for number in range(min(3, len(seeds_of(group, kind.name)))):
        outcome = tried(sound(kind, group, number), seconds=60.0)
        assert outcome.result == "accepted", outcome


def test_a_case_is_given_by_its_seed_and_number():
    for group in GROUPS:
        for number in range(5):
            assert Case.of(group, 3, number) == Case.of(group, 3, number)
    assert Case.of("yaml", 3, 1).content != Case.of("yaml", 4, 1).content


# What the harness finds.


@pytest.mark.long
def test_a_process_that_crashes_is_told_and_replaced(monkeypatch):
    monkeypatch.setenv("PYTHONPATH", str(ROOT / "tests" / "support"))
    worker = Worker(seed=0)
    try:
        assert worker.begin(("inputs", 7))
        os.kill(worker.process.pid, signal.SIGSEGV)
        assert _ended(worker).result == "crash"
        assert worker.begin(("inputs", 7))
        assert _ended(worker).result != "crash"
    finally:
        worker.end()


def _ended(worker: Worker) -> Outcome:
    while (outcome := worker.outcome()) is None:
        time.sleep(0.1)
    return outcome


def _refuse(path: Path) -> None:
    raise DataError("no")


def _spin(path: Path) -> None:
    while True:
        pass


def _warn(path: Path) -> None:
    warnings.warn("odd", UserWarning, stacklevel=1)


@pytest.mark.parametrize(
    ("read", "result"),
    [
        (_refuse, "refused"),
        (lambda path: note("a column is passed over"), "accepted"),
        (lambda path: {}["x"], "foreign"),
        (lambda path: sys.exit(0), "foreign"),
        (lambda path: time.sleep(3.0), "slow"),
        (_spin, "slow"),
        (lambda path: np.ones(10**7).sum(), "memory"),
        (lambda path: "odd", "nonsense"),
        (_warn, "warning"),
    ],
)
def test_failures_are_told_apart(read, result, monkeypatch):
    monkeypatch.setattr(trial, "BYTES", 5 * 10**7)

    def nonsense(value, file):
        return ["a value"] if value == "odd" else []

    kind = replace(GROUPS["inputs"][0], read=read, nonsense=nonsense)
    case = replace(sound(GROUPS["inputs"][0], "inputs"), kind=kind)
    seconds = 0.2 if result == "slow" else 20.0
    assert tried(case, seconds=seconds).result == result
