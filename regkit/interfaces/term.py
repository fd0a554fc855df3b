"""Terms: demands on a pose besides explaining the data, and weights of primitives."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar

from regkit.body import Body
from regkit.config.plugin import Plugin
from regkit.interfaces.compiled import CompiledPart
from regkit.interfaces.kernel import Similarity
from regkit.interfaces.prior import Prior
from regkit.observation import Observation
from regkit.primitives import Placed, Primitives
from regkit.skeleton import Pose
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Scene:
    """The state at the start of a frame's registration.

    Attributes:
        body: The body.
        observation: The frame's data.
        prior: What is known of the pose before the frame.
        placed: The primitives in the start pose.
    """

    body: Body
    observation: Observation
    prior: Prior
    placed: Placed[Any]


@dataclass(frozen=True)
class JointResponse:
    """An energy of the joints and its derivatives.

    Attributes:
        energy: The energy.
        force: Derivative to the degrees of freedom at the pose, (n,).
        stiffness: Positive semi-definite curvature, (n, n).
    """

    energy: float
    force: Array
    stiffness: Array


class JointEnergy(ABC):
    """An energy of the joints alone."""

    @abstractmethod
    def __call__(self, pose: Pose) -> JointResponse:
        """Returns the energy of a pose, its derivative and its curvature."""


@dataclass(frozen=True)
class VisibilityWeights:
    """Visibility of each primitive: factors (K,) of the weights, from 0 to 1."""

    factors: Array


Effect = VisibilityWeights | Similarity | JointEnergy
"""Effect of a term: weights of primitives, or an energy of primitives or joints."""


class Term(Plugin, ABC):
    """A demand on a pose, which combines with any kernel."""

    group = "regkit.terms"

    accepts: ClassVar[type[Primitives]] = Primitives
    """Type of primitives that the term supports."""

    informed: ClassVar[bool] = False
    """Whether its energy of the joints contains that of a prior with information."""

    reads_landmarks: ClassVar[bool] = False
    """Whether it looks at the landmarks of a frame."""

    weighs: ClassVar[bool] = False
    """Whether the term returns visibility weights, to which the kernel is bound, and no energy."""

    def check(self, body: Body) -> None:
        """Checks that the term supports a body, before any frame is read.

        Raises:
            RegkitError: If the body lacks something that the term needs.
        """

    @abstractmethod
    def bind(self, scene: Scene) -> Effect:
        """Binds the term to a frame."""

    def compiled(self, body: Body, primitives: Primitives) -> CompiledPart | None:
        """Returns the term as compiled functions for a body's primitives; None if it has none.

        They compute what ``bind`` and the bound term compute; a subclass that changes these without
        overriding this method has none.
        """
        return None
