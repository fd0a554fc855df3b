"""Long work tells its progress: in bars on a terminal, in a line each minute in a pipe."""

import io
import time

import pytest
from places import EXAMPLES
from rich.console import Console

from regkit.cli import progress
from regkit.cli.progress import ProgressDisplay
from regkit.system.progress import show_on, steps, working

WALK = EXAMPLES / "data" / "human_walk"


@pytest.fixture
def shown(monkeypatch) -> ProgressDisplay:
    """A display in a pipe whose clock stands at 75 s after each begin."""
    monkeypatch.setattr("regkit.system.progress._DISPLAYS", [])
    times = iter([0.0])
    display = ProgressDisplay(Console(file=io.StringIO()), clock=lambda: next(times, 75.0))
    show_on(display)
    return display


def test_line_names_the_tasks_their_steps_and_the_time(shown):
    seen = []
    with working("aligning"):
        seen += [shown.line() for _ in steps(range(3), "tracking", 3)]
    assert seen[0] == "aligning, tracking 0 of 3 (1:15)"
    assert seen[2] == "aligning, tracking 2 of 3 (1:15)"


def test_line_of_many_tasks_is_short(shown):
    tasks = [shown.begin(f"task {one}", None) for one in range(40)]
    assert shown.line() == "task 0, task 1, task 2, 37 more (1:15)"
    for task in tasks:
        shown.end(task)


def test_pipe_gets_a_line_at_each_interval_while_there_is_work(monkeypatch):
    monkeypatch.setattr(progress, "EVERY", 0.01)
    written = io.StringIO()
    display = ProgressDisplay(Console(file=written))
    task = display.begin("rendering", 10)
    while written.getvalue().count("rendering 0 of 10") < 2:
        time.sleep(0.01)
    display.end(task)
    time.sleep(0.03)
    lines = written.getvalue()
    time.sleep(0.05)
    assert written.getvalue() == lines


def test_terminal_gets_bars_for_nested_work():
    written = io.StringIO()
    display = ProgressDisplay(Console(file=written, force_terminal=True, width=80))
    whole = display.begin("recordings x methods", 2)
    inner = display.begin("rendering", None)
    display.advance(whole, 2)
    display.end(inner)
    display.end(whole, keep=True)
    assert "recordings x methods" in written.getvalue()
    assert "2/2" in written.getvalue()


def test_work_that_fails_is_shown_no_longer(shown):
    with pytest.raises(ValueError, match="odd"), working("fitting"):
        raise ValueError("odd")
    assert shown.line().startswith(" (")


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (("track", WALK, "--frames", "2", "--set", "template.height=1.63"), "looking for the body"),
        (("align", "CLOUD", "CLOUD"), "aligning"),
    ],
)
def test_command_tells_what_it_is_doing(regkit, monkeypatch, tmp_path, arguments, expected):
    """At every change, as if a minute had passed."""
    lines = []
    monkeypatch.setattr("regkit.cli.app.display", shown_in(lines))
    monkeypatch.chdir(tmp_path)
    cloud = EXAMPLES / "data" / "mannequin" / "clouds" / "000000.npz"
    assert regkit(*[cloud if one == "CLOUD" else one for one in arguments]).code == 0
    assert expected in lines


def shown_in(lines: list[str]) -> ProgressDisplay:
    class Told(ProgressDisplay):
        def begin(self, what, total, done=0):
            task = super().begin(what, total, done)
            lines.append(self.line().partition(" (")[0])
            return task

        def advance(self, task, by=1):
            super().advance(task, by)
            lines.append(self.line().partition(" (")[0])

    return Told(Console(file=io.StringIO()))
