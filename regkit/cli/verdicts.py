"""What a verdict means for the command line: a line on standard error, and an exit code."""

from __future__ import annotations

import typer

from regkit.cli.console import print_error, print_warning
from regkit.cli.exit_codes import DONE, NOT_FOUND
from regkit.system.errors import RegkitError
from regkit.tracking import Verdict


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
