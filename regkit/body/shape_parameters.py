"""Parameters of shape models, as listed in templates."""

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
    """Parameters of one primitive in its segment's frame, as a template lists them.

    The fields are the keys that a user writes. A shape model declares its class as
    ``ShapeModel.parameters``.
    """

    @abstractmethod
    def deformed(self, deformation: Deformation) -> Self:
        """Returns the primitive in a scaled, stretched or mirrored segment."""

    @abstractmethod
    def moments(self) -> tuple[Array, Array]:
        """Returns mean (3,) [m] and covariance (3, 3) [m^2] of the solid in its segment's frame."""

    @classmethod
    @abstractmethod
    def fitted(cls, points: Array, like: Self | None = None) -> Self:
        """Returns the primitive that fills evenly spread points inside a mesh.

        Args:
            points: Points in the segment's frame, (N, 3) [m].
            like: Parameters of another template at this place, whose options the result keeps.
        """

    def yaml(self) -> str:
        """Returns a mapping in one line, with four decimals of lengths [m], one of angles [deg]."""
        return fields_row(self)


class UncheckedParameters(ShapeParameters):
    """Parameters of a shape model that cannot be loaded here, kept unchanged.

    Only the shape model itself can check, deform or fit them.
    """

    key: str
    """Key of the list in ``shapes``: the shape model's kind, and the name of a named list."""
    reason: str
    """Reason why it cannot be loaded."""
    given: Mapping[str, Any]
    """The listed parameters."""

    def deformed(self, deformation: Deformation) -> Self:
        """Refuses, since the shape model is unknown.

        Raises:
            ConfigError: Always.
        """
        self.refuse()

    def moments(self) -> tuple[Array, Array]:
        """Refuses, since the shape model is unknown.

        Raises:
            ConfigError: Always.
        """
        self.refuse()

    @classmethod
    def fitted(cls, points: Array, like: Self | None = None) -> Self:
        """Refuses, since the shape model is unknown.

        Raises:
            ConfigError: Always.
        """
        assert like is not None
        like.refuse()

    def yaml(self) -> str:
        """Returns the listed parameters unchanged."""
        return json.dumps(self.given, ensure_ascii=False)

    def refuse(self) -> Never:
        """Raises an error that names the required shape model.

        Raises:
            ConfigError: Always.
        """
        raise ConfigError(
            f"parameters of '{self.key}' cannot be changed or fitted without their shape model "
            f"({self.reason}); install it, or remove them from the template",
            place=f"shapes.{self.key}",
        )
