"""Methods: whole ways to find a body's pose in one frame."""

from __future__ import annotations

from abc import ABC, abstractmethod

from regkit.body import Body
from regkit.config.plugin import Plugin
from regkit.interfaces.registrar import Registrar
from regkit.interfaces.tracker import Tracker


class Method(Plugin, ABC):
    """A way to register a body to a frame."""

    group = "regkit.methods"

    tracker: Tracker | None = None
    """How one frame's pose leads to the next with this method; the experiment's tracker without
    it."""

    @abstractmethod
    def bind(self, body: Body) -> Registrar:
        """Do once what does not depend on the data.

        Raises:
            RegkitError: If the method cannot register such a body.
        """
