"""Templates: bodies before their size is known."""

from __future__ import annotations

from abc import ABC, abstractmethod
from pathlib import Path
from typing import Any

import numpy as np

from regkit.body import Body, BodyDescription
from regkit.clouds.reading import READABLE
from regkit.config.plugin import Plugin
from regkit.config.preset import YAML


class Template(Plugin, ABC):
    """A body that can be had in any size."""

    group = "regkit.templates"

    @classmethod
    def named(cls, name: str) -> dict[str, Any]:
        """Data for a name alone: a kind, the YAML file of a template, or a rigid cloud or mesh."""
        suffix = Path(name).suffix.lower()
        if suffix in YAML:
            return cls.default("file", path=name)
        return cls.default("cloud", path=name) if suffix in READABLE else super().named(name)

    @abstractmethod
    def description(self) -> BodyDescription:
        """What the template's YAML says.

        Raises:
            RegkitError: If the file is missing or wrong.
        """

    @abstractmethod
    def given_size(self) -> float | None:
        """Returns the size that the user gave [m], or None if it is to be found from the data."""

    def candidate_sizes(self, count: int = 5) -> tuple[float, ...]:
        """Returns the given size alone, or ``count`` sizes over the range that occurs [m]."""
        given = self.given_size()
        if given is not None:
            return (given,)
        smallest, largest = self.description().size.range
        if smallest == largest:
            return (smallest,)
        return tuple(float(size) for size in np.geomspace(smallest, largest, count))

    def name(self) -> str:
        """What the body is called in messages."""
        return self.kind

    def body(self, size: float) -> Body:
        """The body whose size is ``size`` [m]."""
        return self.description().body(self.name(), size)
