"""YAML documents that know on which line each of their values stands."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails
from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap, CommentedSeq
from ruamel.yaml.error import MarkedYAMLError, YAMLError

from regkit.config.model import Text
from regkit.system.errors import ConfigError, DataError

M = TypeVar("M", bound=BaseModel)
T = TypeVar("T")
Location = tuple[str | int, ...]


@dataclass(frozen=True)
class Document:
    """A mapping read from YAML, and where each value came from.

    Attributes:
        data: Plain dictionaries, lists and scalars; texts are ``Text`` and know their folder.
        places: For the location of each value, ``file:line`` or the command-line option that set
            it.
    """

    data: dict[str, Any]
    places: Mapping[Location, str]

    @classmethod
    def read(cls, path: Path) -> Document:
        """Read a YAML 1.2 file whose top is a mapping.

        Raises:
            ConfigError: If it is not YAML, repeats a key, or is not a mapping.
            DataError: If the file is missing or not text.
        """
        try:
            text = path.read_text(encoding="utf-8")
        except FileNotFoundError:
            raise DataError("there is no such file", place=str(path)) from None
        except IsADirectoryError:
            raise DataError("this is a folder; name a YAML file", place=str(path)) from None
        except (OSError, UnicodeDecodeError) as error:
            raise DataError(f"cannot be read as text: {error}", place=str(path)) from None
        tree = _parsed(text, str(path))
        if not isinstance(tree, CommentedMap):
            raise ConfigError(
                "the file must hold a mapping of fields (name: value)", place=f"{path}:1"
            )
        places: dict[Location, str] = {(): f"{path}:1"}
        data = _plain(tree, (), path, places)
        return cls(data, places)

    def overridden(self, settings: Iterable[str]) -> Document:
        """The document after ``a.b.c=value`` settings, whose values are YAML.

        Raises:
            ConfigError: If a setting is not of that form, or its value cannot be there.
        """
        document = self
        for setting in settings:
            option = f"--set {setting}"
            name, equals, value = setting.partition("=")
            keys = name.split(".")
            if not equals or not all(keys):
                raise ConfigError("a setting must read a.b.c=value", place=option)
            document = document.changed(keys, _copied(_parsed(value, option)), place=option)
        return document

    def changed(self, keys: Iterable[str], value: Any, *, place: str) -> Document:
        """The document with one value that is new or another.

        Args:
            keys: The way to the value; an item of a list is named by its number, from 0.
            value: What is to stand there.
            place: Where that was said.

        Raises:
            ConfigError: If the way goes through something that is no mapping and no list, or there
                is no such item in a list.
        """
        data = _copied(self.data)
        inner: Any = data
        way: Location = ()
        *around, last = keys
        for key in around:
            way = (*way, _position(inner, key, way, place))
            within = inner.get(way[-1], {}) if isinstance(inner, dict) else inner[way[-1]]
            if isinstance(within, str):  # The short form `shape: gsog` grows into a mapping.
                within = {"kind": within}
            if not isinstance(within, dict | list):
                raise ConfigError(f"{'.'.join(map(str, way))} is not a mapping", place=place)
            inner[way[-1]] = within
            inner = within
        way = (*way, _position(inner, last, way, place))
        inner[way[-1]] = _copied(value)
        places = {at: said for at, said in self.places.items() if at[: len(way)] != way}
        return Document(data, places | {way: place})

    def without(self, key: str) -> Document:
        """The document without one of its uppermost fields."""
        data = {name: value for name, value in self.data.items() if name != key}
        return Document(data, {at: place for at, place in self.places.items() if at[:1] != (key,)})

    def place(self, location: Location) -> str:
        """``file:line: field`` of a value, or of the nearest one around it that was written."""
        written = location
        while written not in self.places:
            written = written[:-1]
        field = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in location)
        return f"{self.places[written]}: {field.lstrip('.')}" if field else self.places[written]

    def validated(self, model: type[M]) -> M:
        """The document as a ``model``.

        Raises:
            ConfigError: One line for each thing that is wrong, with its file, line and field.
        """
        return self._checked(model.model_validate, self.data, ())

    def field(self, name: str, validate: Callable[[Any], T]) -> T:
        """One of the uppermost fields, whatever the others hold.

        Args:
            name: The field.
            validate: Pydantic's validation of the type that the field has.

        Raises:
            ConfigError: As ``validated``.
        """
        return self._checked(validate, self.data[name], (name,))

    def _checked(self, validate: Callable[[Any], T], data: Any, at: Location) -> T:
        try:
            return validate(data)
        except ValidationError as error:
            lines = [self._complaint(details, at) for details in error.errors(include_url=False)]
            raise ConfigError("\n".join(dict.fromkeys(lines))) from None

    def _complaint(self, details: ErrorDetails, at: Location) -> str:
        absent = details["type"] == "missing"
        location = self._written((*at, *details["loc"]), absent=absent)
        given = details["input"]
        shown = isinstance(given, (str, int, float, bool)) and not details["type"].startswith(
            _SPEAKING
        )
        message = details["msg"].removeprefix("Value error, ").replace("a valid tuple", "a list")
        return f"{self.place(location)}: {message[0].lower()}{message[1:]}" + (
            f"; it is {given!r}" if shown else ""
        )

    def _written(self, location: Location, *, absent: bool) -> Location:
        """The location without the tags that pydantic puts in where a union was decided."""
        value: Any = self.data
        kept: list[str | int] = []
        for part in location:
            if isinstance(part, int) and isinstance(value, dict):
                part = str(part)  # Items of a preset's list are named by their numbers.
            try:
                value = value[part]
            except (KeyError, IndexError, TypeError):
                continue
            kept.append(part)
        return (*kept, location[-1]) if absent else tuple(kept)


def _position(around: Any, key: str, way: Location, place: str) -> str | int:
    """The key of a mapping, or the number of an item of a list."""
    if not isinstance(around, list):
        return key
    if not key.isdecimal() or int(key) >= len(around):
        raise ConfigError(
            f"{'.'.join(map(str, way))} is a list of {len(around)}, whose items are named by "
            f"numbers from 0; there is no item '{key}'",
            place=place,
        )
    return int(key)


_SPEAKING = ("unknown_field", "plugin_", "value_error")
"""Kinds of errors whose message already shows the value."""


def yaml_text(data: Any) -> str:
    """``data`` as YAML that a person can read."""
    stream = StringIO()
    yaml = YAML(typ="safe", pure=True)
    yaml.default_flow_style = False
    yaml.sort_base_mapping_type_on_output = False  # type: ignore[assignment]
    yaml.dump(data, stream)
    return stream.getvalue()


def yaml_data(text: str) -> Any:
    """What ``yaml_text`` wrote.

    Raises:
        ConfigError: If it is no YAML any more.
    """
    return _copied(_parsed(text, "text"))


def _parsed(text: str, place: str) -> Any:
    try:
        return YAML(typ="rt").load(text)
    except MarkedYAMLError as error:
        line = (
            f":{error.problem_mark.line + 1}" if error.problem_mark and "--set" not in place else ""
        )
        reason = (error.problem or "not YAML").splitlines()[0]
        raise ConfigError(f"not valid YAML: {reason}", place=f"{place}{line}") from None
    except YAMLError as error:
        raise ConfigError(f"not valid YAML: {str(error).splitlines()[0]}", place=place) from None


def _plain(node: Any, location: Location, path: Path, places: dict[Location, str]) -> Any:
    """``node`` without ruamel's types; the lines are noted in ``places`` on the way."""
    if isinstance(node, CommentedMap):
        for key in node:
            line = node.lc.data[key][0] if key in (node.lc.data or {}) else node.lc.line
            places[*location, key] = f"{path}:{line + 1}"
        return {str(key): _plain(node[key], (*location, key), path, places) for key in node}
    if isinstance(node, CommentedSeq):
        for index in range(len(node)):
            places[*location, index] = f"{path}:{node.lc.item(index)[0] + 1}"
        return [_plain(item, (*location, index), path, places) for index, item in enumerate(node)]
    if isinstance(node, str):
        return Text(node, path.parent.absolute())
    return _copied(node)


def _copied(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _copied(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_copied(item) for item in value]
    if isinstance(value, float):
        return float(value)
    if isinstance(value, int) and not isinstance(value, bool):
        return int(value)
    return value
