"""Templates at a size, which their search then need not estimate."""

from __future__ import annotations

from typing import Literal

from regkit.body import Body, BodyDescription
from regkit.interfaces import Template


class OfSize(Template):
    """A template whose size is given."""

    kind: Literal["of_size"] = "of_size"
    template: Template
    """The template."""
    size: float
    """Its size [m]."""

    def description(self) -> BodyDescription:
        """Returns the description of the template."""
        return self.template.description()

    def given_size(self) -> float:
        """Returns the size [m]."""
        return self.size

    def body(self, size: float) -> Body:
        """Returns the template's body."""
        return self.template.body(size)

    def coarse(self) -> Template | None:
        """Returns the template that is searched for first, at the same size."""
        coarse = self.template.coarse()
        return None if coarse is None else OfSize(template=coarse, size=self.size)

    def name(self) -> str:
        """Returns the template's name."""
        return self.template.name()
