"""Several templates in one: bodies that move freely beside each other."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Literal, Self

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from regkit.body import Body, BodyDescription
from regkit.body.composition import Member, beside, scaled
from regkit.interfaces.template import Template
from regkit.skeleton.description import Name
from regkit.system.errors import RegkitError


class Composed(Template):
    """Several templates in one, which compete for the same points.

    The bodies in ``free`` move freely beside each other, such as two hands, or a hand and an object
    that it grasps. The names of their segments and markers begin with the body's: the palm of
    ``left`` is ``left_palm``.
    """

    kind: Literal["composed"] = "composed"
    free: dict[Name, Template] = Field(min_length=1)
    """Bodies that move freely beside each other, by name. A body without a given size keeps its
    proportion to the first one without, whose size is that of the whole."""

    @model_validator(mode="after")
    def _compose_early(self) -> Self:
        try:
            self.description()
        except RegkitError as error:
            raise PydanticCustomError("plugin_error", "{error}", {"error": str(error)}) from error
        return self

    def description(self) -> BodyDescription:
        """Returns the description of the whole.

        Raises:
            RegkitError: If two bodies have segments of the same name, or a file is invalid.
        """
        return self._composed(1.0)

    def given_size(self) -> float | None:
        """Returns the size of the first body [m], if those of all bodies are given."""
        sizes = [template.given_size() for template in self.free.values()]
        return None if None in sizes else sizes[0]

    def input_files(self) -> Iterable[Path]:
        """Returns the files of all templates."""
        return [path for template in self.free.values() for path in template.input_files()]

    def body(self, size: float) -> Body:
        """Returns the whole at a size [m]; bodies with a given size keep it."""
        description = self._composed(size / self.description().size.value)
        return description.body(self.name(), description.size.value)

    def _composed(self, factor: float) -> BodyDescription:
        """Returns the description of the whole, with bodies without a given size in a scale."""
        members = []
        for name, template in self.free.items():
            own = template.description()
            size = template.given_size() or factor * own.size.value
            members.append(Member(name, scaled(own, size), prefix=f"{name}_"))
        title = " and ".join(f"{name}: {one.kind}" for name, one in self.free.items())
        return beside(title, members, self._leading)

    @property
    def _leading(self) -> int:
        """Index of the first body without a given size, or of the first one."""
        sizes = [template.given_size() for template in self.free.values()]
        return sizes.index(None) if None in sizes else 0
