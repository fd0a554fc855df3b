"""Documents: configuration with the source location of each value."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from regkit.config.changes import Location, with_value
from regkit.config.yaml import read_mapping, yaml_value
from regkit.system.errors import ConfigError, RegkitError
from regkit.system.printable import shortened

M = TypeVar("M", bound=BaseModel)
T = TypeVar("T")

_SELF_CONTAINED = ("unknown_field", "plugin_", "value_error")
"""Types of errors whose message already shows the value."""

LONGEST_SETTING = 200
"""Number of characters of a setting that messages show."""

MOST_MISTAKES = 20
"""Number of a document's mistakes that are told at once."""


@dataclass(frozen=True)
class Document:
    """A mapping with the source location of each of its values.

    Attributes:
        data: Plain dictionaries, lists and scalars; strings are ``Text`` and know their folder.
        places: ``file:line``, or the setting, of the value at each location. A value without an
            entry has the place of the nearest enclosing one.
    """

    data: dict[str, Any]
    places: Mapping[Location, str]

    @classmethod
    def read(cls, path: Path) -> Document:
        """Reads a YAML 1.2 file that holds a mapping.

        Raises:
            ConfigError: If it is not YAML, repeats a key, or does not hold a mapping.
            DataError: If the file is missing or not text.
        """
        return cls(*read_mapping(path))

    def overridden(self, settings: Iterable[str], *, called: str = "setting") -> Document:
        """Returns the document after ``a.b.c=value`` settings, whose values are YAML.

        Args:
            settings: The settings, applied in order.
            called: Name of a setting in messages, such as an option.

        Raises:
            ConfigError: If a setting does not have this form, or its path is invalid.
        """
        document = self
        for setting in settings:
            place = f"{called} {shortened(setting, LONGEST_SETTING)}"
            name, equals, text = setting.partition("=")
            keys = name.split(".")
            if not equals or not all(keys):
                raise ConfigError("a setting must read a.b.c=value", place=place)
            try:
                value = yaml_value(text)
            except RegkitError as error:
                raise error.at(place) from None
            document = document.changed(keys, value, place=place)
        return document

    def changed(self, keys: Iterable[str], value: Any, *, place: str) -> Document:
        """Returns the document with one value added or replaced.

        Args:
            keys: Path to the value; items of a list are given by their index, from 0.
            value: The value.
            place: Where the value was written.

        Raises:
            ConfigError: If the path passes through a scalar, or a list has no such item.
        """
        try:
            data, location = with_value(self.data, tuple(keys), value)
        except ConfigError as error:
            raise error.at(place) from None
        places = {at: there for at, there in self.places.items() if at[: len(location)] != location}
        ways = (location[:length] for length in range(1, len(location)))
        added = {way: place for way in ways if not _holds(self.data, way)}
        return Document(data, places | added | {location: place})

    def without(self, key: str) -> Document:
        """Returns the document without one of its top-level fields."""
        data = {name: value for name, value in self.data.items() if name != key}
        return Document(data, {at: place for at, place in self.places.items() if at[:1] != (key,)})

    def place(self, location: Location) -> str:
        """Returns ``file:line: field`` of a value; the field alone without a known place."""
        nearest = (location[:length] for length in range(len(location), -1, -1))
        written = next((self.places[at] for at in nearest if at in self.places), "")
        field = "".join(
            f"[{part}]" if isinstance(part, int) else f".{shortened(part)}" for part in location
        )
        return ": ".join(filter(None, (written, field.lstrip("."))))

    def validated(self, model: type[M]) -> M:
        """Returns the document as a ``model``.

        Raises:
            ConfigError: One line for each mistake, with its file, line and field.
        """
        return self._checked(model.model_validate, self.data, ())

    def field(self, name: str, validate: Callable[[Any], T]) -> T:
        """Returns one of the top-level fields, without validating the others.

        Args:
            name: The field.
            validate: Pydantic's validation of the field's type.

        Raises:
            ConfigError: As ``validated``.
        """
        return self._checked(validate, self.data[name], (name,))

    def _checked(self, validate: Callable[[Any], T], data: Any, at: Location) -> T:
        try:
            return validate(data)
        except ValidationError as error:
            every = (self._complaint(details, at) for details in error.errors(include_url=False))
            lines = list(dict.fromkeys(every))
            more = len(lines) - MOST_MISTAKES
            told = [*lines[:MOST_MISTAKES], f"and {more} more mistakes"] if more > 0 else lines
            raise ConfigError("\n".join(told)) from None
        except RecursionError:
            raise ConfigError("presets name each other without end", place=self.place(at)) from None

    def _complaint(self, details: ErrorDetails, at: Location) -> str:
        absent = details["type"] == "missing"
        location = self._written((*at, *details["loc"]), absent=absent)
        given = details["input"]
        shown = isinstance(given, (str, int, float, bool)) and not details["type"].startswith(
            _SELF_CONTAINED
        )
        message = details["msg"].removeprefix("Value error, ").replace("a valid tuple", "a list")
        complaint = f"{message[0].lower()}{message[1:]}"
        if details["type"] == "bool_type":
            complaint += ": true or false"  # In YAML 1.2, yes and off are text.
        if shown:
            complaint += f"; it is {shortened(repr(given))}"
        return ": ".join(filter(None, (self.place(location), complaint)))

    def _written(self, location: Location, *, absent: bool) -> Location:
        """Returns the location without the tags that pydantic inserts for unions."""
        value: Any = self.data
        kept: list[str | int] = []
        for part in location:
            if isinstance(part, int) and isinstance(value, dict):
                part = str(part)  # Items of a preset's list have their index as key.
            try:
                value = value[part]
            except (KeyError, IndexError, TypeError):
                continue
            kept.append(part)
        return (*kept, location[-1]) if absent else tuple(kept)


def _holds(data: Any, location: Location) -> bool:
    """Whether a value exists at a location."""
    for part in location:
        try:
            data = data[part]
        except (KeyError, IndexError, TypeError):
            return False
    return True
