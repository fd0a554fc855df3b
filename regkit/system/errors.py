"""Errors that a user can cause, each with the place to correct."""

from __future__ import annotations


class RegkitError(Exception):
    """Base of every error that regkit raises on purpose; the CLI prints it without a traceback.

    Args:
        message: What is wrong, naming the value, and what would be right.
        place: What to correct: ``file:line: field``, a file, or a command-line option.
    """

    def __init__(self, message: str, *, place: str | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.place = place

    def __str__(self) -> str:
        """The place, if it is known, and the message."""
        return f"{self.place}: {self.message}" if self.place else self.message

    def at(self, place: str) -> RegkitError:
        """The same error at ``place``, unless it already knows a place of its own."""
        return self if self.place else type(self)(self.message, place=place)


class ConfigError(RegkitError):
    """A YAML document or a command-line override says something that cannot be."""


class DataError(RegkitError):
    """Measured data (an image, a cloud, a truth file) is missing, damaged or unusable."""


class PluginError(RegkitError):
    """A plug-in is unknown or broken."""


class DependencyError(RegkitError):
    """A library or system package is missing; the message holds the command that installs it."""
