"""Registrars: methods bound to a body, which register it to frames."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence

import numpy as np

from regkit.body import Body
from regkit.interfaces.prior import Prior
from regkit.interfaces.result import Evaluation, RegistrationResult
from regkit.observation import Observation
from regkit.primitives import Primitives
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.brief import Brief
from regkit.system.errors import ConfigError


class Registrar(Brief, ABC):
    """A method bound to a body.

    Attributes:
        body: The body.
        primitives: The primitives of the body's shape model.
    """

    body: Body
    primitives: Primitives

    @abstractmethod
    def register(
        self,
        observation: Observation,
        candidates: Sequence[Pose],
        *,
        prior: Prior | None = None,
        warm_start: RegistrationResult | None = None,
    ) -> RegistrationResult:
        """Registers the body to a frame.

        The candidate that explains the frame best is the start, and everything is bound to it.

        Args:
            observation: The frame's data.
            candidates: Candidate start poses, at least one.
            prior: What is known of the pose; by default the first candidate, as a pose alone.
            warm_start: Result of the previous frame, from which a solver may reuse more than the
                pose.
        """

    def register_each(
        self, observation: Observation, starts: Sequence[Pose], *, accuracy: float = np.inf
    ) -> list[RegistrationResult]:
        """Registers the body to one frame from each of several starts; one result for each.

        A method that prepares the frame at length may do so once, and may follow starts that have
        met only once.

        Args:
            observation: The frame's data.
            starts: The starts.
            accuracy: Root mean square distance [m] of the body's points from where they belong at
                the right start; a method need not search farther.
        """
        return [self.register(observation, [start]) for start in starts]

    @abstractmethod
    def evaluate(self, observation: Observation, pose: Pose) -> Evaluation:
        """Returns the quality of a pose for a frame without changing the pose."""

    @property
    def reads_landmarks(self) -> bool:
        """Whether the method looks at the landmarks of a frame."""
        return False

    def effective_points(self, observation: Observation, pose: Pose) -> float:
        """Returns the effective number of independent points of a frame in a registered pose.

        It is far below the number of points, because neighbouring residuals are correlated: what
        the model lacks, it lacks for all points of a limb. NaN if the method has no residuals.

        Args:
            observation: The frame's data.
            pose: The registered pose.
        """
        return float("nan")

    def gradient(self, observation: Observation, pose: Pose) -> Array:
        """Returns the derivative of the energy to a step of ``Skeleton.retract``, (n,).

        Everything is bound to the frame at this pose, which is the prior too: where it vanishes, a
        registration that starts there ends there. A method without such an energy need not have it.

        Args:
            observation: The frame's data.
            pose: The pose.

        Raises:
            ConfigError: If the method has no energy with a derivative.
        """
        raise ConfigError(
            f"{type(self).__name__} has no energy with a derivative to the pose, by which shapes "
            "are tuned; take a method of the kind that has, such as the default one"
        )

    def normal_equations(self, observation: Observation, pose: Pose) -> tuple[float, Array, Array]:
        """Returns the energy, its derivative (n,) as ``gradient``, and the curvature (n, n).

        Everything is bound to the frame at this pose.

        Args:
            observation: The frame's data.
            pose: The pose.

        Raises:
            ConfigError: If the method has no energy with a curvature.
        """
        raise ConfigError(
            f"{type(self).__name__} has no energy with a curvature, which this needs; take a "
            "method of the kind that has, such as the default one"
        )
