"""A notebook shows progress in the cell that runs; a script and IPython's terminal do not."""

import sys
from dataclasses import dataclass, field
from types import SimpleNamespace

import pytest
from places import EXAMPLES

import regkit
from regkit.system.notebook import NotebookDisplay
from regkit.system.progress import is_shown, steps, working

WALK = EXAMPLES / "data" / "human_walk"


@dataclass
class FakeShell:
    """IPython's shell: it keeps what each output shows, and how often it changed."""

    kernel: object = field(default_factory=object)
    execution_count: int = 1
    outputs: dict[str, dict[str, str]] = field(default_factory=dict)
    texts: list[str] = field(default_factory=list)

    @property
    def display_pub(self):
        return self

    def publish(self, data, *, transient, update):
        place = transient["display_id"]
        assert update == (place in self.outputs), "one output is made, and then updated"
        self.outputs[place] = data
        self.texts.append(data["text/plain"])

    @property
    def html(self) -> str:
        (output,) = self.outputs.values()
        return output["text/html"]


@pytest.fixture
def no_display(monkeypatch) -> None:
    monkeypatch.setattr("regkit.system.progress._DISPLAYS", [])


@pytest.fixture
def shell(monkeypatch, no_display) -> FakeShell:
    """The kernel that runs this process."""
    shell = FakeShell()
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: shell))
    return shell


def unhurried(shell) -> NotebookDisplay:
    """A display for which a second passes between two looks at the clock."""
    seconds = iter(range(1000))
    return NotebookDisplay(shell, clock=lambda: float(next(seconds)))


def test_counted_steps_end_as_a_complete_bar(shell, monkeypatch):
    monkeypatch.setattr("regkit.system.progress._DISPLAYS", [unhurried(shell)])
    assert list(steps("abc", "tracking", 3)) == ["a", "b", "c"]
    assert shell.texts == [f"tracking {done} of 3" for done in (0, 1, 2, 3, 3)]
    assert "value='3' max='3'" in shell.html


def test_work_without_steps_is_shown_while_it_lasts(shell):
    with working("searching <the> start"):
        assert "<progress style" in shell.html
        assert "searching &lt;the&gt; start" in shell.html
    assert shell.html == ""


def test_work_in_work_is_shown_below_it(shell):
    with working("calibrating"), working("fitting"):
        assert shell.html.index("calibrating") < shell.html.index("fitting")
        assert shell.html.count("<progress") == 2


def test_bar_of_steps_that_end_early_stays_where_it_was(shell):
    for step in steps(range(5), "tracking", 5):
        if step == 2:
            break
    assert "value='2' max='5'" in shell.html


def test_each_cell_has_an_output_of_its_own(shell):
    list(steps("ab", "tracking", 2))
    shell.execution_count = 2
    with working("aligning"):
        pass
    assert [one["text/plain"] for one in shell.outputs.values()] == ["tracking 2 of 2", ""]


def test_what_an_interrupted_cell_left_is_not_shown_in_the_next(shell):
    left = steps("abc", "tracking", 3)
    next(left)
    shell.execution_count = 2
    with working("aligning"):
        next(left)
        assert shell.texts[-1] == "aligning"
    left.close()
    assert shell.texts[-1] == ""


def test_many_quick_steps_are_few_messages(shell):
    list(steps(range(10_000), "tracking", 10_000))
    assert len(shell.texts) < 100
    assert shell.texts[-1] == "tracking 10000 of 10000"


@pytest.mark.parametrize(
    "ipython",
    [
        None,
        SimpleNamespace(),
        SimpleNamespace(get_ipython=lambda: None),
        SimpleNamespace(get_ipython=lambda: SimpleNamespace(execution_count=1)),
    ],
    ids=["script", "half imported", "imported by a script", "terminal"],
)
def test_nothing_is_shown_without_a_kernel(ipython, no_display, monkeypatch, capfd):
    monkeypatch.setitem(sys.modules, "IPython", ipython)
    assert not is_shown()
    with working("aligning"):
        assert list(steps("ab", "tracking", 2)) == ["a", "b"]
    assert capfd.readouterr() == ("", "")


def test_tracking_shows_the_search_and_then_the_frames(shell):
    walk = regkit.load_recording(WALK, frames=2)
    regkit.track(walk, regkit.load_template("human", height=1.63))
    assert shell.texts[0] == "searching the start"
    assert shell.texts[-1] == "tracking 2 of 2"
