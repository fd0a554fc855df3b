"""Shape models: what stands for the surface of a body."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar

from regkit.body import Body
from regkit.config.plugin import Plugin
from regkit.primitives import Primitives


class ShapeModel(Plugin, ABC):
    """Turns a body into primitives that its segments carry; it never sees a joint."""

    group = "regkit.shapes"
    declared = ("makes",)

    makes: ClassVar[type[Primitives]]
    """The type of the primitives."""

    @abstractmethod
    def bind(self, body: Body) -> Primitives:
        """Primitives in the frames of the body's segments."""
