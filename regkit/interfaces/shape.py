"""Shape models: what stands for the surface of a body."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar

from regkit.body import Body, ParametricShape
from regkit.geometry.capsules import Capsules
from regkit.primitives import Primitives
from regkit.system.errors import ConfigError


class ShapeModel(ParametricShape, ABC):
    """Turns a body into primitives that its segments carry; it never sees a joint.

    One whose ``parameters`` are a class finds what the template lists in ``body.shapes``, scaled to
    the body's size.
    """

    group = ParametricShape.group
    declared = ("makes",)

    makes: ClassVar[type[Primitives]]
    """The type of the primitives."""

    def capsules_of(self, body: Body) -> Capsules:
        """Returns the body's capsules, of which the shape model makes its primitives.

        Raises:
            ConfigError: If the body has none.
        """
        if not len(body.capsules):
            raise ConfigError(
                f"the template '{body.name}' has no capsules, of which the shape '{self.kind}' is "
                "made; give its segments some, or take a shape that the template lists"
            )
        return body.capsules

    @abstractmethod
    def bind(self, body: Body) -> Primitives:
        """Primitives in the frames of the body's segments."""
