"""Methods: complete algorithms that register a body to a frame."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable

from regkit.body import Body
from regkit.config.plugin import Plugin
from regkit.interfaces.registrar import Registrar
from regkit.interfaces.shape import ShapeModel
from regkit.interfaces.tracker import Tracker
from regkit.system.errors import ConfigError, FieldError


class Method(Plugin, ABC):
    """An algorithm that registers a body to a frame."""

    group = "regkit.methods"

    tracker: Tracker | None = None
    """Tracker for this method; the experiment's tracker by default."""

    def shape_model(self) -> ShapeModel | None:
        """Returns the shape model whose primitives are registered; None if there is no choice."""
        return None

    def check(self, body: Body) -> None:
        """Checks that the method's fields fit a body, before any frame is read.

        By default its tracker's are checked.

        Raises:
            RegkitError: If one does not, with its field if it is a ``FieldError``.
        """
        if self.tracker is not None:
            check_field(self.tracker.check, body, "tracker")

    @abstractmethod
    def bind(self, body: Body) -> Registrar:
        """Binds the method to a body, with all work that does not depend on the data.

        Raises:
            RegkitError: If the method cannot register such a body.
        """


def check_field(check: Callable[[Body], None], body: Body, *location: str | int) -> None:
    """Checks that a plug-in fits a body, and tells in which field it is if it does not.

    Args:
        check: The plug-in's check.
        body: The body.
        location: The field of the plug-in.

    Raises:
        FieldError: If it does not fit.
    """
    try:
        check(body)
    except FieldError as error:
        raise error.within(*location) from None
    except ConfigError as error:
        raise FieldError(error.message, *location) from None
