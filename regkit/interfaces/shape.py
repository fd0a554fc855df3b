"""Shape models: representations of a body's surface by primitives."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any, ClassVar

from regkit.body import Body, ListedShape, ParametricShape
from regkit.body.shape_keys import ListName, list_key, names_of
from regkit.geometry.capsules import Capsules
from regkit.primitives import Primitives
from regkit.system.errors import ConfigError


class ShapeModel(ParametricShape, ABC):
    """A map from a body to primitives on its segments, independent of the joints.

    A shape model whose primitives a template can list derives from ``ListedShapeModel``.
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


class ListedShapeModel(ShapeModel, ABC):
    """A shape model whose primitives a template can list; it sets ``parameters`` to their class.

    A template can hold several lists, such as primitives that are tuned for different methods.
    """

    tuned: ListName | None = None
    """Name of the template's list of primitives, which it holds as ``KIND/NAME``; by default the
    list ``KIND``."""

    def listed(self, body: Body) -> ListedShape[Any] | None:
        """Returns the primitives that the template lists, at the body's size.

        Returns:
            The primitives; None if no list is named and the template has none for this kind.

        Raises:
            ConfigError: If the template lacks the named list.
        """
        key = list_key(self.kind, self.tuned)
        if self.tuned is not None and key not in body.shapes:
            names = names_of(self.kind, body.shapes)
            held = f"only {', '.join(names)}" if names else "no named list"
            raise ConfigError(
                f"the template '{body.name}' has no list '{key}' of primitives, which the shape "
                f"'{self.kind}' needs with tuned: {self.tuned}; for '{self.kind}' it has {held}"
            )
        return body.shapes.get(key)
