"""Base class of methods that call another library to register rigid clouds."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy

from regkit.body import Body
from regkit.clouds import spacing
from regkit.geometry.rigid import transformed
from regkit.interfaces import Evaluation, Method, Prior, Registrar, RegistrationResult
from regkit.observation import Observation
from regkit.primitives import Primitives
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError, RegkitError


@dataclass(frozen=True)
class Aligned:
    """The result of a library.

    Attributes:
        transform: T_target_source, (4, 4).
        converged: Whether it converged; true if the library does not report it.
        iterations: Number of iterations; 0 if the library does not report it.
        message: Reason of termination.
    """

    transform: Array
    converged: bool
    iterations: int
    message: str


class RigidMethod(Method, ABC):
    """A method of another library that aligns a source cloud to a target cloud."""

    @abstractmethod
    def library(self) -> object:
        """Imports the library.

        Raises:
            DependencyError: If it is missing.
        """

    @abstractmethod
    def aligned(self, source: Array, target: Array, start: Array, size: float) -> Aligned:
        """Aligns a source to a target.

        Args:
            source: Points to align, (N, 3) [m].
            target: Fixed points, (M, 3) [m].
            start: Initial T_target_source, (4, 4).
            size: Size of the source [m], the scale of all lengths.
        """

    def bind(self, body: Body) -> BoundRigidMethod:
        """Binds the method to a body of one segment.

        Raises:
            ConfigError: If the body has joints, a fixed root, or no surface.
            DependencyError: If the library is missing.
        """
        segments = len(body.skeleton.names)
        if segments > 1:
            raise ConfigError(
                f"method '{self.kind}' is rigid, but the template '{body.name}' has {segments} "
                "segments; choose a method for articulated bodies"
            )
        if not body.skeleton.free:
            raise ConfigError(
                f"method '{self.kind}' needs a free root, but that of the template '{body.name}' "
                "is fixed"
            )
        if body.surface is None:
            raise ConfigError(
                f"the template '{body.name}' has no surface, which method '{self.kind}' aligns; "
                "choose a template with a mesh or a cloud"
            )
        self.library()
        points = body.surface.points[:, 0]
        primitives = Primitives(
            segments=body.surface.segments[:, 0],
            centres=points,
            axes=np.broadcast_to(np.eye(3), (len(points), 3, 3)),
            scales=np.zeros((len(points), 3)),
            weights=np.ones(len(points)),
        )
        return BoundRigidMethod(self, body, primitives)


@dataclass(frozen=True)
class BoundRigidMethod(Registrar):
    """A library's method bound to a body of one segment.

    Attributes:
        method: The method.
        body: The body.
        primitives: The points of the body's surface.
    """

    method: RigidMethod
    body: Body
    primitives: Primitives

    def register(
        self,
        observation: Observation,
        candidates: Sequence[Pose],
        *,
        prior: Prior | None = None,
        warm_start: RegistrationResult | None = None,
    ) -> RegistrationResult:
        """Registers from the best candidate; priors and warm starts are not used.

        Raises:
            DataError: If the library fails, or its result is not a rigid motion.
        """
        start = candidates[0]
        if len(candidates) > 1:
            start = min(candidates, key=lambda pose: self.evaluate(observation, pose).energy)
        target = np.ascontiguousarray(observation.points)
        try:
            found = self.method.aligned(self.primitives.centres, target, start.root, self.body.size)
        except RegkitError:
            raise
        except Exception as error:
            raise DataError(
                f"method '{self.method.kind}' failed: {type(error).__name__}: {error}"
            ) from error
        _check_rigid(found.transform, self.method.kind)
        pose = Pose(np.asarray(found.transform), start.balls, start.hinges)
        evaluation = self.evaluate(observation, pose)
        return RegistrationResult(
            pose,
            evaluation.energy,
            evaluation.inlier_share,
            found.converged,
            found.iterations,
            0,
            found.message,
        )

    def evaluate(self, observation: Observation, pose: Pose) -> Evaluation:
        """Evaluates the distances of the data to the body's points, in units of their spacing."""
        tree = scipy.spatial.KDTree(transformed(pose.root, self.primitives.centres))
        distances = tree.query(observation.points)[0] / self._spacing
        inliers = np.exp(-0.5 * distances**2)
        return Evaluation(float(1.0 - inliers.mean()), inliers)

    @cached_property
    def _spacing(self) -> float:
        return spacing(self.primitives.centres)


def _check_rigid(transform: Array, kind: str) -> None:
    finite = np.isfinite(transform).all()
    rotation = np.asarray(transform)[:3, :3]
    if not finite or np.abs(rotation.T @ rotation - np.eye(3)).max() > 1e-4:
        raise DataError(
            f"method '{kind}' returned a transform that is not a rigid motion: "
            f"{np.round(transform, 4).tolist()}"
        )
