"""Exit codes: what a verdict means for a command, and several verdicts for a run."""

import itertools

import pytest
import typer

from regkit.cli.exit_codes import DONE, ERROR, NOT_FOUND
from regkit.cli.verdicts import conclude, run_exit_code
from regkit.experiment import Outcome
from regkit.metrics import METRICS, Measure
from regkit.tracking import Verdict

FOUND, DOUBTFUL, LOST = Verdict.FOUND, Verdict.DOUBTFUL, Verdict.LOST


def measure(verdict: Verdict | None) -> Measure:
    return Measure(**dict.fromkeys(METRICS), verdict=verdict)


def outcome(*methods: list[Verdict | None], failed: bool = False) -> Outcome:
    """Methods with their verdicts on recordings 0, 1, ..."""
    measures = {
        f"m{rank}": {str(index): measure(one) for index, one in enumerate(verdicts)}
        for rank, verdicts in enumerate(methods)
    }
    return Outcome(measures, {"m0": {"0": "why"} if failed else {}})


@pytest.mark.parametrize(
    ("given", "strict", "code"),
    [
        (outcome([FOUND, FOUND], [LOST, LOST]), False, DONE),
        (outcome([FOUND, LOST], [LOST, FOUND]), False, DONE),
        (outcome([FOUND, LOST], [FOUND, LOST]), False, NOT_FOUND),
        (outcome([DOUBTFUL], [LOST]), False, DONE),
        (outcome([DOUBTFUL], [LOST]), True, NOT_FOUND),
        (outcome([DOUBTFUL], [FOUND]), True, DONE),
        (outcome([LOST], failed=True), False, ERROR),
        (outcome([None]), True, DONE),
        (outcome([]), False, DONE),
    ],
)
def test_run_fails_only_where_no_method_found_the_body(given, strict, code):
    assert run_exit_code(given, strict=strict) == code


@pytest.mark.parametrize(
    ("verdict", "strict"), list(itertools.product((FOUND, DOUBTFUL, LOST), (0, 1)))
)
def test_doubt_is_told_and_loss_is_an_exit_code(verdict, strict, capsys):
    failed = verdict is LOST or (strict and verdict is DOUBTFUL)
    if failed:
        with pytest.raises(typer.Exit) as caught:
            conclude(verdict, "this is why", strict=bool(strict))
        assert caught.value.exit_code == NOT_FOUND
    else:
        conclude(verdict, "this is why", strict=bool(strict))
    told = capsys.readouterr()
    assert not told.out
    assert "this is why" in told.err
