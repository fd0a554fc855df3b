"""Ctrl-C is noted in a long run, unless the process was started to ignore it."""

import signal
import subprocess
import sys

import pytest
from places import EXAMPLES

from regkit.cli.interrupt import Interrupt
from regkit.system.plugin_code import plugin_code


@pytest.fixture(autouse=True)
def heard():
    """As in a terminal; what runs in the background may ignore Ctrl-C."""
    former = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, former)


def test_interrupt_is_answered_when_it_is_asked_for():
    with Interrupt(checked=True) as interrupt:
        interrupt.check()
        signal.raise_signal(signal.SIGINT)
        with pytest.raises(KeyboardInterrupt):
            interrupt.check()
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_second_interrupt_ends_at_once():
    with Interrupt(checked=True), plugin_code("a plug-in in a command"):
        signal.raise_signal(signal.SIGINT)
        with pytest.raises(SystemExit) as ended:
            signal.raise_signal(signal.SIGINT)
    assert ended.value.code == 130


def test_interrupt_that_nobody_checks_ends_at_once():
    with Interrupt() as interrupt, pytest.raises(SystemExit) as ended:
        signal.raise_signal(signal.SIGINT)
    assert ended.value.code == 130
    assert interrupt.pressed


def test_command_that_does_not_end_by_itself_is_ended(capfd):
    """In a process of its own, which hears no exception for a minute."""
    program = (
        "import time\n"
        "from regkit.cli import interrupt\n"
        "interrupt.PATIENCE = 0.1\n"
        "with interrupt.Interrupt('stopping', checked=True) as one:\n"
        "    one.last_words = 'continue later'\n"
        "    interrupt.signal.raise_signal(interrupt.signal.SIGINT)\n"
        "    time.sleep(60.0)\n"
    )
    ended = subprocess.run([sys.executable, "-c", program], check=False, timeout=30)
    assert ended.returncode == 130
    assert capfd.readouterr().err.splitlines()[-1] == "continue later"


@pytest.mark.parametrize("command", ["register", "track", "calibrate"])
def test_command_is_interrupted_while_it_searches_the_start(regkit, tmp_path, monkeypatch, command):
    def pressed(*_: object, **__: object) -> None:
        signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr("regkit.tracking.Session.begin", pressed)
    walk = EXAMPLES / "data" / "human_walk"
    out = tmp_path / ("out.yaml" if command == "calibrate" else "out")
    ended = regkit(command, walk, "--out", out)
    assert ended.code == 130
    assert ended.err == "interrupted\n"
    assert not out.exists()


def test_ignored_interrupt_stays_ignored():
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with Interrupt() as interrupt:
        signal.raise_signal(signal.SIGINT)
        interrupt.check()
    assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN
