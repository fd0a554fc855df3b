"""A template of the user's own, in a YAML file."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from regkit.body import BodyDescription
from regkit.config.model import InputPath
from regkit.interfaces.template import Template
from regkit.system.errors import RegkitError
from regkit_plugins.templates.reading import description_in


class FileTemplate(Template):
    """Any linkage, described in a YAML file.

    The file is read and checked while the configuration is. Proportions are what the file says,
    under ``sources``.
    """

    kind: Literal["file"] = "file"
    path: InputPath
    """The template's YAML file."""
    size: Annotated[float, Field(gt=0.0)] | None = None
    """What the file's ``size`` names [m]; without it, several in its range are tried."""

    @model_validator(mode="after")
    def _read_early(self) -> Self:
        try:
            description = self.description()
            description.body(self.kind, description.size.value)
        except RegkitError as error:
            # This type of error keeps pydantic's input out of the message, which has the path.
            raise PydanticCustomError("plugin_error", "{error}", {"error": str(error)}) from error
        return self

    def description(self) -> BodyDescription:
        """What the file says.

        Raises:
            RegkitError: If the file is missing or wrong.
        """
        return description_in(self.path)

    def name(self) -> str:
        """The file's name."""
        return self.path.stem

    def given_size(self) -> float | None:
        """The size [m], if it is given."""
        return self.size
