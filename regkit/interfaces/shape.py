"""Shape models: representations of a body's surface by primitives."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar

from regkit.body import Body, ParametricShape
from regkit.geometry.capsules import Capsules
from regkit.primitives import Primitives
from regkit.system.errors import ConfigError


class ShapeModel(ParametricShape, ABC):
    """A map from a body to primitives on its segments, independent of the joints.

    The primitives that a template lists for a shape model with ``parameters`` are available in
    ``body.shapes``, scaled to the body's size.
    """

    group = ParametricShape.group
    declared = ("makes",)

    makes: ClassVar[type[Primitives]]
    """Type of the primitives."""

    def capsules_of(self, body: Body) -> Capsules:
        """Returns the body's capsules for a shape model that needs them.

        Raises:
            ConfigError: If the body has none.
        """
        if not len(body.capsules):
            raise ConfigError(
                f"the template '{body.name}' has no capsules, which the shape '{self.kind}' needs; "
                "give its segments some, or use a shape that the template lists"
            )
        return body.capsules

    @abstractmethod
    def bind(self, body: Body) -> Primitives:
        """Returns primitives in the frames of the body's segments."""
