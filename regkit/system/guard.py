"""The one guard between a reader and the bytes of others."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from regkit.system.errors import DataError, RegkitError

LONGEST = 200
"""Number of characters of a foreign message that are shown."""


@contextmanager
def reading(path: Path | str, what: str) -> Iterator[None]:
    """Context manager: whatever a reader raises on damaged bytes becomes a DataError.

    A library that parses foreign bytes may raise anything, from ``struct.error`` to
    ``RecursionError``. A list of its exceptions is never complete, so none is listed.

    Args:
        path: The file, for the place of the error.
        what: What the file should be, such as ``"a glTF file"``.

    Raises:
        DataError: If the body raises anything but a RegkitError, which gets the place if it has
            none.
    """
    try:
        yield
    except RegkitError as error:
        raise error.at(str(path)) from None
    except Warning:
        # A note that the user turns into an error is not damage.
        raise
    except FileNotFoundError:
        raise DataError("there is no such file", place=str(path)) from None
    except IsADirectoryError:
        raise DataError("this is a folder, not a file", place=str(path)) from None
    except OSError as error:
        # Only the operating system's own errors have a number; libraries raise others on damage.
        reason = f"not {what}: {foreign(error)}"
        if error.errno is not None and error.strerror:
            reason = f"cannot be read: {error.strerror}"
        raise DataError(reason, place=str(path)) from None
    except MemoryError:
        raise DataError(
            f"not {what}: it asks for more memory than there is", place=str(path)
        ) from None
    except Exception as error:
        raise DataError(f"not {what}: {foreign(error)}", place=str(path)) from None


def _told(error: BaseException) -> str:
    """Returns an exception's message; those of pydantic and of mappings begin with no reason."""
    # An error of pydantic comes from its module, which a command's list does not wait for.
    pydantic = sys.modules.get("pydantic")
    if pydantic is not None and isinstance(error, pydantic.ValidationError):
        first = error.errors(include_url=False)[0]
        field = ".".join(map(str, first["loc"]))
        return f"{field}: {first['msg']}" if field else str(first["msg"])
    return f"{error} is missing" if isinstance(error, KeyError) else str(error)


def foreign(error: BaseException) -> str:
    """Returns the first line of a foreign exception's message, cut, or its kind without one."""
    try:
        lines = _told(error).strip().splitlines()
    except Exception:  # An exception of others may not even have a text.
        lines = []
    text = lines[0] if lines else type(error).__name__
    return text if len(text) <= LONGEST else f"{text[:LONGEST]} ..."
