"""The parameters of shape models: what a template lists of each primitive."""

from __future__ import annotations

import json
from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any, Never, Self

from regkit.body.deformation import Deformation
from regkit.body.rows import fields_row
from regkit.config.model import Model
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError


class ShapeParameters(Model, ABC):
    """One primitive of a shape model in the frame of its segment, as a template lists it.

    The fields are what a user writes. A shape model names its own class as
    ``ShapeModel.parameters``.
    """

    @abstractmethod
    def deformed(self, deformation: Deformation) -> Self:
        """Returns the primitive in a segment that is scaled, stretched or mirrored."""

    @abstractmethod
    def moments(self) -> tuple[Array, Array]:
        """Returns the solid's mean (3,) [m] and covariance (3, 3) [m^2] in the segment's frame."""

    @classmethod
    @abstractmethod
    def fitted(cls, points: Array, like: Self | None = None) -> Self:
        """Returns the primitive that fills points (N, 3) [m], which lie evenly inside a mesh.

        Args:
            points: In the segment's frame.
            like: What another template lists here; its options are kept.
        """

    def yaml(self) -> str:
        """A mapping in one line, with four decimals of lengths [m] and one of angles [deg]."""
        return fields_row(self)


class UncheckedParameters(ShapeParameters):
    """A primitive of a shape model that cannot be loaded here: kept as it stands.

    Its shape model alone could check, deform or fit it.
    """

    kind: str
    """The shape model."""
    reason: str
    """Why it cannot be loaded."""
    given: Mapping[str, Any]
    """What the template lists."""

    def deformed(self, deformation: Deformation) -> Self:
        """Nobody knows.

        Raises:
            ConfigError: Always.
        """
        self.refuse()

    def moments(self) -> tuple[Array, Array]:
        """Nobody knows.

        Raises:
            ConfigError: Always.
        """
        self.refuse()

    @classmethod
    def fitted(cls, points: Array, like: Self | None = None) -> Self:
        """Nobody knows.

        Raises:
            ConfigError: Always.
        """
        assert like is not None
        like.refuse()

    def yaml(self) -> str:
        """As it stands."""
        return json.dumps(self.given, ensure_ascii=False)

    def refuse(self) -> Never:
        """Say which shape model is needed.

        Raises:
            ConfigError: Always.
        """
        raise ConfigError(
            f"parameters of '{self.kind}' cannot be changed or fitted without their shape model "
            f"({self.reason}); install it, or remove them from the template",
            place=f"shapes.{self.kind}",
        )
