"""Terms: what is asked of a pose beyond explaining the data, and which primitives take part."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar

from regkit.body import Body
from regkit.config.plugin import Plugin
from regkit.interfaces.kernel import Similarity
from regkit.observation import Observation
from regkit.primitives import Placed, Primitives
from regkit.skeleton import Pose
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Scene:
    """What is known when a frame's registration begins.

    Attributes:
        body: What is registered.
        observation: The frame's data.
        prior: The pose that is kept where the data say nothing.
        placed: The primitives in the pose from which the frame is registered.
    """

    body: Body
    observation: Observation
    prior: Pose
    placed: Placed[Any]


@dataclass(frozen=True)
class JointResponse:
    """An energy of the joints and its derivative.

    Attributes:
        energy: The energy.
        force: Its derivative to the degrees of freedom at the pose, (n,).
        stiffness: A positive semi-definite matrix (n, n) of its curvature.
    """

    energy: float
    force: Array
    stiffness: Array


class JointEnergy(ABC):
    """An energy that looks at the joints alone."""

    @abstractmethod
    def __call__(self, pose: Pose) -> JointResponse:
        """Returns the energy in a pose, its derivative and its curvature."""


@dataclass(frozen=True)
class VisibilityWeights:
    """By how much each primitive is visible: factors (K,) on the weights, from 0 to 1."""

    factors: Array


Effect = VisibilityWeights | Similarity | JointEnergy
"""What a term does: weigh the primitives, or add an energy of them or of the joints."""


class Term(Plugin, ABC):
    """One demand on a pose, which any kernel can be combined with."""

    group = "regkit.terms"

    accepts: ClassVar[type[Primitives]] = Primitives
    """The primitives that it can look at."""

    weighs: ClassVar[bool] = False
    """Whether it gives visibility weights, which the kernel is bound with, and not an energy."""

    def check(self, body: Body) -> None:
        """Refuse a body that the term cannot be used with, before any frame is read.

        Raises:
            RegkitError: If it asks for what the body does not have.
        """

    @abstractmethod
    def bind(self, scene: Scene) -> Effect:
        """Bind the term to a frame."""
