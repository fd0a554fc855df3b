"""Templates: bodies of undetermined size."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from regkit.body import Body, BodyDescription
from regkit.clouds.reading import READABLE
from regkit.config.input_files import paths_in
from regkit.config.plugin import Plugin
from regkit.config.preset import YAML


class Template(Plugin, ABC):
    """A body available in any size."""

    group = "regkit.templates"

    @classmethod
    def named(cls, name: str) -> dict[str, Any]:
        """Returns data for a name: a kind, or the file of a template, rigid cloud or mesh."""
        suffix = Path(name).suffix.lower()
        if suffix in YAML:
            return cls.default("file", path=name)
        return cls.default("cloud", path=name) if suffix in READABLE else super().named(name)

    @abstractmethod
    def description(self) -> BodyDescription:
        """Returns the description in the template's YAML.

        Raises:
            RegkitError: If the file is missing or invalid.
        """

    def input_files(self) -> Iterable[Path]:
        """Returns all paths in the configuration, and the mesh and modes of the description."""
        described = self.description()
        beside = [path for path in (described.mesh, described.modes) if path is not None]
        return [*paths_in(self, Plugin), *beside]

    @abstractmethod
    def given_size(self) -> float | None:
        """Returns the size given by the user [m]; None if it must be estimated from the data."""

    def candidate_sizes(self, count: int = 5) -> tuple[float, ...]:
        """Returns the given size alone, or ``count`` sizes over the range of the template [m]."""
        given = self.given_size()
        if given is not None:
            return (given,)
        smallest, largest = self.description().size.range
        if smallest == largest:
            return (smallest,)
        return tuple(float(size) for size in np.geomspace(smallest, largest, count))

    def extended(self) -> Template | None:
        """Returns the template with further parts that the data may show; by default None.

        They are optional segments: a start keeps this template only if data lie on them. It has the
        sizes of the other one.
        """
        return None

    def chosen(self, *, extended: bool) -> Template:
        """Returns the extended template, or this one, as a start has chosen."""
        longer = self.extended() if extended else None
        return self if longer is None else longer

    def plain(self) -> Template:
        """Returns this template, of which no start chooses the extended one."""
        return self

    def coarse(self) -> Template | None:
        """Returns the template that is searched for first, before its parts; by default None.

        A body of this template then has the other's body as its ``base``.
        """
        return None

    def free_bodies(self) -> Mapping[str, Template]:
        """Returns the templates of several bodies that move freely beside each other, by name.

        A body of this template then has theirs as its ``free_bodies``, in the same order and at
        their sizes. By default there is one body, and the mapping is empty.
        """
        return {}

    def name(self) -> str:
        """Returns the name of the body in messages."""
        return self.kind

    def body(self, size: float) -> Body:
        """Returns the body of a size [m]."""
        return self.description().body(self.name(), size)
