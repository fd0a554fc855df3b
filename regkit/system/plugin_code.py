"""The boundary to code of others: what would end the program is an error of a plug-in."""

from __future__ import annotations

import traceback
from collections.abc import Iterator
from contextlib import contextmanager

from regkit.system.errors import PluginError
from regkit.system.guard import foreign


class Ended(SystemExit):
    """The program's own end, as after a second Ctrl-C, which is no fault of a plug-in."""


@contextmanager
def plugin_code(what: str) -> Iterator[None]:
    """Context manager: ``sys.exit`` and the like in a plug-in become a PluginError.

    Only Ctrl-C, with the exceptions derived from it, ``Ended`` and ordinary exceptions pass.

    Args:
        what: The plug-in, file or command in messages.

    Raises:
        PluginError: If the body raises any other ``BaseException``; its place is the line that
            raised it.
    """
    try:
        yield
    except (Exception, KeyboardInterrupt, GeneratorExit, Ended):
        raise
    except BaseException as error:
        raise PluginError(
            f"{what} tried to end the program: {described(error)}; a plug-in must raise an error "
            "instead",
            place=raised_at(error),
        ) from error


def described(error: BaseException) -> str:
    """Returns the kind and the message of any exception; ``sys.exit(2)`` as such."""
    if isinstance(error, SystemExit):
        return f"it calls sys.exit({'' if error.code is None else repr(error.code)})"
    text = foreign(error)
    kind = type(error).__name__
    return kind if text == kind else f"{kind}: {text}"


def raised_at(error: BaseException, within: str | None = None) -> str | None:
    """Returns ``file:line`` of the code that raised an exception.

    Args:
        error: The exception.
        within: Only lines of this file count.
    """
    frames = [
        frame
        for frame in traceback.extract_tb(error.__traceback__)
        if within is None or frame.filename == within
    ]
    return f"{frames[-1].filename}:{frames[-1].lineno}" if frames else None
