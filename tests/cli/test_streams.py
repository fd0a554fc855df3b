"""Standard output that is full, closed, or cannot show a character."""

from __future__ import annotations

import io
import os
import subprocess
import sys
from pathlib import Path

import pytest

from regkit.cli.console import _SafeConsole
from regkit.cli.streams import flush_output, standard_streams
from regkit.system.errors import DataError

needs_full_device = pytest.mark.skipif(
    not Path("/dev/full").exists(), reason="the system has no device that is always full"
)


def to(path: str | int, encoding: str = "utf-8") -> io.TextIOWrapper:
    return open(path, "w", encoding=encoding)  # noqa: PTH123 - the test closes it.


def unread_pipe() -> int:
    reading, writing = os.pipe()
    os.close(reading)
    return writing


def test_output_that_nobody_reads_is_lost_and_the_command_goes_on(monkeypatch):
    monkeypatch.setattr(sys, "stdout", to(unread_pipe()))
    with standard_streams():
        for _ in range(3):
            print("x" * 10_000)
            flush_output()
    sys.stdout.close()


@needs_full_device
def test_full_output_is_an_error(monkeypatch):
    monkeypatch.setattr(sys, "stdout", to("/dev/full"))
    with standard_streams():
        print("x")
        with pytest.raises(DataError, match="space") as caught:
            flush_output()
    assert caught.value.place == "standard output"
    sys.stdout.close()


@needs_full_device
def test_full_errors_are_lost(monkeypatch):
    monkeypatch.setattr(sys, "stderr", to("/dev/full"))
    with standard_streams():
        print("x" * 10_000, file=sys.stderr, flush=True)
    sys.stderr.close()


def test_closed_output_is_no_error(monkeypatch):
    monkeypatch.setattr(sys, "stdout", None)
    with standard_streams():
        print("x")
        flush_output()


def test_character_that_a_terminal_does_not_have_is_an_escape(monkeypatch, tmp_path):
    monkeypatch.setattr(sys, "stdout", to(str(tmp_path / "out"), "ascii"))
    with standard_streams():
        print("30 \xb0, 步")
    sys.stdout.close()
    assert (tmp_path / "out").read_text() == "30 \\xb0, \\u6b65\n"


def test_console_shows_names_as_they_are_and_moves_no_cursor():
    stream = io.StringIO()
    console = _SafeConsole(file=stream, width=80, emoji=False)
    console.print("[red]a[/x] :a: \x1b[2J\u202e\udcff", soft_wrap=True, highlight=False)
    assert stream.getvalue() == "[red]a[/x] :a: \\x1b[2J\\u202e\\udcff\n"


@needs_full_device
@pytest.mark.parametrize(("arguments", "code"), [(("--help",), 1), (("nothing",), 2)])
def test_exit_code_of_a_full_output_is_right(arguments, code):
    with Path("/dev/full").open("w") as full:
        ended = subprocess.run(
            [sys.executable, "-m", "regkit", *arguments],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
    assert ended.returncode == code
    assert "Traceback" not in ended.stderr
    assert "Exception" not in ended.stderr


def test_exit_code_of_a_reader_that_left_is_that_of_the_command():
    writing = unread_pipe()
    ended = subprocess.run(
        [sys.executable, "-m", "regkit", "--help"],
        stdout=writing,
        stderr=subprocess.PIPE,
        text=True,
        check=False,
        env={**os.environ, "PYTHONIOENCODING": "ascii", "LC_ALL": "C"},
    )
    os.close(writing)
    assert ended.returncode == 0
    assert ended.stderr == ""
