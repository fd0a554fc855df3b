"""Methods: whole ways to find a body's pose in one frame."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass

from regkit.body import Body
from regkit.observation import Observation
from regkit.plugin import Plugin
from regkit.primitives import Primitives
from regkit.skeleton import Pose


@dataclass(frozen=True)
class Registered:
    """The outcome of one registration.

    Attributes:
        pose: The pose found.
        energy: Its energy, in the method's own units.
        converged: Whether the solver met a tolerance.
        iterations: Its steps.
        evaluations: How often it looked at the energy.
        message: Why it ended.
    """

    pose: Pose
    energy: float
    converged: bool
    iterations: int
    evaluations: int
    message: str


class Registrar(ABC):
    """A method made ready for one body.

    Attributes:
        body: The body.
        primitives: What its shape model made of the body.
    """

    body: Body
    primitives: Primitives

    @abstractmethod
    def register(
        self, observation: Observation, start: Pose, *, blurs: Sequence[float] | None = None
    ) -> Registered:
        """The body's pose in a frame.

        Args:
            observation: The frame's data.
            start: A pose near the one sought.
            blurs: Standard deviations [m] to smooth the energy with, one registration after the
                other; without them the method's own.
        """


class Method(Plugin, ABC):
    """A way to register a body to a frame."""

    group = "regkit.methods"

    @abstractmethod
    def prepare(self, body: Body) -> Registrar:
        """Do once what does not depend on the data.

        Raises:
            RegkitError: If the method cannot register such a body.
        """
