"""A template in the user's YAML file."""

from __future__ import annotations

from typing import Literal, Self

from pydantic import model_validator
from pydantic_core import PydanticCustomError

from regkit.body import BodyDescription
from regkit.body.reading import description_in
from regkit.config.model import InputPath, misplaced
from regkit.config.quantities import Length
from regkit.interfaces.template import Template
from regkit.system.errors import RegkitError


class FileTemplate(Template):
    """Any articulated body, described in a YAML file.

    The file is read and validated together with the configuration. Its ``sources`` name the origin
    of its proportions.
    """

    kind: Literal["file"] = "file"
    path: InputPath
    """YAML file of the template."""
    size: Length | None = None
    """The body's size, as defined by ``size`` in the file [m]; by default it is estimated within
    the file's range, which a given size must lie in too."""

    @model_validator(mode="after")
    def _read_early(self) -> Self:
        try:
            description = self.description()
            description.body(self.kind, description.size.value)
        except RegkitError as error:
            # This error type keeps pydantic from adding the input to the message with the path.
            raise PydanticCustomError("plugin_error", "{error}", {"error": str(error)}) from error
        smallest, largest = description.size.range
        if self.size is not None and not smallest <= self.size <= largest:
            raise misplaced(
                type(self),
                f"{self.size:g} m is beyond the template's {description.size.name} of {smallest:g} "
                f"to {largest:g} m (size.range in {self.path.name})",
                "size",
            )
        return self

    def description(self) -> BodyDescription:
        """Returns the description in the file.

        Raises:
            RegkitError: If the file is missing or invalid.
        """
        return description_in(self.path)

    def name(self) -> str:
        """Returns the name of the file."""
        return self.path.stem

    def given_size(self) -> float | None:
        """Returns the size [m], if it is set."""
        return self.size
