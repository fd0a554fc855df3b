"""Shape models: what stands for the surface of a body."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar

from regkit.body import Body, ParametricShape
from regkit.primitives import Primitives


class ShapeModel(ParametricShape, ABC):
    """Turns a body into primitives that its segments carry; it never sees a joint.

    One whose ``parameters`` are a class finds what the template lists in ``body.shapes``, scaled to
    the body's size.
    """

    group = ParametricShape.group
    declared = ("makes",)

    makes: ClassVar[type[Primitives]]
    """The type of the primitives."""

    @abstractmethod
    def bind(self, body: Body) -> Primitives:
        """Primitives in the frames of the body's segments."""
