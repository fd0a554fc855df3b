"""Errors that a user can cause, each with the place to correct."""

from __future__ import annotations

from regkit.system.printable import cut, one_line, printable


class RegkitError(Exception):
    """Base of all errors that regkit raises on purpose; the CLI prints it without a traceback.

    Args:
        message: What is wrong, with the offending value, and what is right.
        place: Where to correct it: ``file:line: field``, a file, or a command-line option.
    """

    def __init__(self, message: str, *, place: str | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.place = place

    def __str__(self) -> str:
        """Returns ``place: message``, or the message alone, safe to print."""
        message = printable(cut(self.message))
        return f"{one_line(self.place)}: {message}" if self.place else message

    def at(self, place: str) -> RegkitError:
        """Returns the error at ``place``, unless it has a place already."""
        return self if self.place else type(self)(self.message, place=place)


class ConfigError(RegkitError):
    """A YAML document, an argument or a command-line override is invalid."""


class FieldError(ConfigError):
    """A field does not fit what it is combined with, such as a joint's name the template.

    Args:
        message: As in ``RegkitError``.
        location: The field: its name, and those of the mappings or the places in the lists that it
            is in, from the outside.
    """

    def __init__(self, message: str, *location: str | int) -> None:
        parts = (f"[{one}]" if isinstance(one, int) else f".{one}" for one in location)
        super().__init__(message, place="".join(parts).lstrip("."))
        self.location = location

    def within(self, *outer: str | int) -> FieldError:
        """Returns the error of the same field as a part of another one."""
        return FieldError(self.message, *outer, *self.location)


class DataError(RegkitError):
    """Measured data (an image, a cloud, a truth file) is missing, damaged or unusable."""


class NoDataError(DataError):
    """A frame has no measurement of the object; tracking bridges such frames."""


class SourceLostError(RegkitError):
    """A camera or recording yields no further frame although it has not ended."""


class NotFoundError(RegkitError):
    """The input is valid, but the body is not in it, or was not found."""


class NoBodyError(NoDataError, NotFoundError):
    """A frame has measurements, but none that may be the body's; tracking bridges such frames."""


class PluginError(RegkitError):
    """A plug-in is unknown or broken."""


class DependencyError(RegkitError):
    """A library or system package is missing; the message names the command to install it."""
