"""Base class of everything that users write in YAML."""

from __future__ import annotations

import difflib
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, ClassVar

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    GetCoreSchemaHandler,
    ValidationError,
    model_validator,
)
from pydantic_core import CoreSchema, InitErrorDetails, PydanticCustomError

from regkit.config.strict_numbers import strict_numbers
from regkit.system.brief import brief_fields
from regkit.system.printable import shortened

LONGEST = 800
"""Number of characters of a model's text that are shown."""


class Model(BaseModel):
    """A frozen record whose fields are documented by the docstrings below them.

    An unknown field is an error that suggests the nearest known one. Numbers and booleans are not
    converted from strings, so regkit accepts exactly what the JSON Schema accepts in an editor.
    """

    renamed: ClassVar[dict[str, str]] = {}
    """New names of renamed fields by their old ones."""

    model_config = ConfigDict(
        frozen=True,
        extra="forbid",
        use_attribute_docstrings=True,
        allow_inf_nan=False,
        validate_default=True,
    )

    def __repr__(self) -> str:
        """Returns the class and its fields, in a few characters each if they are many."""
        text = super().__repr__()
        return text if len(text) <= LONGEST else brief_fields(self, dict(self))

    def __str__(self) -> str:
        """Returns the same."""
        return repr(self)

    @classmethod
    def __get_pydantic_core_schema__(
        cls, source: type[Any], handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        """Returns the schema of the fields, with strict numbers."""
        return strict_numbers(handler(source), cls)

    @model_validator(mode="before")
    @classmethod
    def _refuse_unknown_fields(cls, value: Any) -> Any:
        if not isinstance(value, dict):
            return value
        unknown = [key for key in value if key not in cls.model_fields]
        if unknown:
            raise ValidationError.from_exception_data(
                cls.__name__,
                [
                    InitErrorDetails(type=_unknown_field(key, cls), loc=(key,), input=value[key])
                    for key in unknown
                ],
            )
        return value


def misplaced(model: type[Model], message: str, *location: str | int) -> ValidationError:
    """Returns an error of the whole model, placed at one of its fields."""
    problem = PydanticCustomError("value_error", "{message}", {"message": message})
    details = InitErrorDetails(type=problem, loc=location, input=None)
    return ValidationError.from_exception_data(model.__name__, [details])


def did_you_mean(name: str, known: list[str], renamed: Mapping[str, str] | None = None) -> str:
    """Returns a hint at the nearest known name, or an empty string.

    Args:
        name: The unknown name.
        known: The names that exist.
        renamed: New names by former ones; a name near a former one hints at the new one.
    """
    new = {**(renamed or {}), **{one: one for one in known}}
    close = difflib.get_close_matches(name, list(new), n=1)
    return f"; did you mean '{shortened(new[close[0]])}'?" if close else ""


def _unknown_field(key: object, model: type[Model]) -> PydanticCustomError:
    if key in model.renamed:
        return PydanticCustomError(
            "unknown_field",
            "'{old}' is now called '{new}'",
            {"old": str(key), "new": model.renamed[str(key)]},
        )
    known = sorted(model.model_fields)
    return PydanticCustomError(
        "unknown_field",
        "no such field (there are: {fields}){hint}",
        {"fields": ", ".join(known), "hint": did_you_mean(str(key), known, model.renamed)},
    )


LONGEST_NAME = 255
"""Maximum length of a file's name on common systems [bytes]."""


class Text(str):
    """A string from a file, which knows the file's folder.

    Relative paths in a YAML file are relative to the file's folder; those on the command line, to
    the working directory. The string carries its folder through any nesting of models.
    """

    __slots__ = ("folder",)
    folder: Path

    def __new__(cls, value: str, folder: Path) -> Text:
        """Returns ``value`` as read from a file in ``folder``."""
        text = super().__new__(cls, value)
        text.folder = folder
        return text

    def __getnewargs__(self) -> tuple[str, Path]:  # type: ignore[override]
        """Returns the arguments for copying."""
        return str(self), self.folder


def path_in(folder: Path, name: str) -> Path:
    """Returns the absolute path of a name that is relative to a folder or the home folder (~).

    Raises:
        ValueError: If no file can have that name.
    """
    if "\0" in name or any(len(os.fsencode(part)) > LONGEST_NAME for part in Path(name).parts):
        raise ValueError(f"'{shortened(name)}' cannot be the path of a file")
    try:
        return folder.absolute() / Path(name).expanduser()
    except RuntimeError:
        home = Path(name).parts[0]
        raise ValueError(f"the home folder '{home}' is not known; write the whole path") from None


def _from_its_folder(value: Any) -> Any:
    if not isinstance(value, str):
        return value
    return path_in(value.folder if isinstance(value, Text) else Path.cwd(), value)


READ = BeforeValidator(_from_its_folder)
"""Marks the paths of what is read."""

InputPath = Annotated[Path, READ]
"""A file or folder to read: relative to the YAML file, or to the working directory."""
