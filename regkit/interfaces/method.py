"""Methods: complete algorithms that register a body to a frame."""

from __future__ import annotations

from abc import ABC, abstractmethod

from regkit.body import Body
from regkit.config.plugin import Plugin
from regkit.interfaces.registrar import Registrar
from regkit.interfaces.shape import ShapeModel
from regkit.interfaces.tracker import Tracker


class Method(Plugin, ABC):
    """An algorithm that registers a body to a frame."""

    group = "regkit.methods"

    tracker: Tracker | None = None
    """Tracker for this method; the experiment's tracker by default."""

    def shape_model(self) -> ShapeModel | None:
        """Returns the shape model whose primitives are registered; None if there is no choice."""
        return None

    @abstractmethod
    def bind(self, body: Body) -> Registrar:
        """Binds the method to a body, with all work that does not depend on the data.

        Raises:
            RegkitError: If the method cannot register such a body.
        """
