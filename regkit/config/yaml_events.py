"""The events of a YAML text, with the line of each error."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError

from regkit.system.errors import ConfigError
from regkit.system.guard import foreign


class Events:
    """The events of ruamel's parser, one after the other.

    Args:
        text: The text.
        place: Its file, for messages.

    Attributes:
        line: Line of the last event, from 1.
    """

    def __init__(self, text: str, place: str | None) -> None:
        self.line = 1
        self._place = place
        self._events: Iterator[Any] = iter(YAML(typ="safe", pure=True).parse(text))

    def next(self) -> Any:
        """Returns the next event.

        Raises:
            ConfigError: If the text is not YAML here.
        """
        try:
            event = next(self._events)
        except MarkedYAMLError as error:
            mark = error.problem_mark or error.context_mark
            self.line = mark.line + 1 if mark else self.line
            raise self.error(f"not valid YAML: {foreign(ValueError(error.problem))}") from None
        except Exception as error:
            raise self.error(f"not valid YAML: {foreign(error)}") from None
        if event.start_mark is not None:
            self.line = event.start_mark.line + 1
        return event

    def error(self, message: str) -> ConfigError:
        """Returns an error at the line of the last event."""
        return ConfigError(message, place=self._place and f"{self._place}:{self.line}")
