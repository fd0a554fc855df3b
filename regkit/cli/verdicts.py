"""What a verdict means for the command line: a line on standard error, and an exit code."""

from __future__ import annotations

from typing import TYPE_CHECKING

import typer

from regkit.cli.console import print_error, print_warning
from regkit.cli.exit_codes import DONE, ERROR, NOT_FOUND
from regkit.system.errors import RegkitError
from regkit.tracking import Verdict

if TYPE_CHECKING:
    from regkit.experiment import Outcome


def conclude(verdict: Verdict, reason: str, *, strict: bool) -> None:
    """Prints why a result is doubtful, as a warning, or lost, as an error, and ends accordingly.

    Args:
        verdict: Whether the body was found.
        reason: Why it is doubtful or lost, or what else is to be told.
        strict: Whether a doubtful result counts as not found.

    Raises:
        Exit: With ``NOT_FOUND``, if the body was not found.
    """
    if verdict is Verdict.LOST:
        print_error(RegkitError(f"lost: {reason}"))
    elif verdict is Verdict.DOUBTFUL:
        print_warning(f"doubtful: {reason}")
    elif reason:
        print_warning(reason)
    code = exit_code(verdict, strict=strict)
    if code != DONE:
        raise typer.Exit(code)


def exit_code(verdict: Verdict, *, strict: bool) -> int:
    """Returns the exit code of a result."""
    missed = verdict is Verdict.LOST or (strict and verdict is Verdict.DOUBTFUL)
    return NOT_FOUND if missed else DONE


def run_exit_code(outcome: Outcome, *, strict: bool) -> int:
    """Returns the exit code of a run: a method that loses a body is a result, unless all lose it.

    Args:
        outcome: The results of all methods.
        strict: Whether doubtful results count as not found.
    """
    if any(outcome.failures.values()):
        return ERROR
    codes: dict[str, set[int]] = {}
    for by_recording in outcome.measures.values():
        for recording, measure in by_recording.items():
            if measure.verdict is not None:
                code = exit_code(Verdict(measure.verdict), strict=strict)
                codes.setdefault(recording, set()).add(code)
    return NOT_FOUND if {NOT_FOUND} in codes.values() else DONE
