"""What the methods of other libraries for rigid clouds have in common."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.spatial import KDTree

from regkit.body import Body
from regkit.clouds import spacing
from regkit.geometry.rigid import rigid, transformed
from regkit.interfaces import Evaluation, Method, Registrar, RegistrationResult
from regkit.observation import Observation
from regkit.primitives import Primitives
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError, RegkitError


@dataclass(frozen=True)
class Aligned:
    """What a library found.

    Attributes:
        transform: T_target_source, (4, 4).
        converged: Whether it says that it met a tolerance; true if it does not tell.
        iterations: Its steps; 0 if it does not tell.
        message: Why it ended.
    """

    transform: Array
    converged: bool
    iterations: int
    message: str


@dataclass(frozen=True)
class Frame:
    """Coordinates in which a cloud is about one long: thresholds of libraries are meant there.

    Attributes:
        origin: Where they begin, (3,) [m].
        unit: Their unit [m].
    """

    origin: Array
    unit: float

    @classmethod
    def around(cls, points: Array, unit: float) -> Frame:
        """Coordinates that begin at the centre of points (N, 3)."""
        return cls(points.mean(axis=0), unit)

    def inside(self, points: Array) -> Array:
        """Points (N, 3) [m] in these coordinates."""
        return (points - self.origin) / self.unit

    def outside(self, rotation: Array, translation: Array) -> Array:
        """The motion (4, 4) [m] of one that is given in these coordinates."""
        shift = self.unit * translation + self.origin - rotation @ self.origin
        return rigid(rotation, shift)


class RigidMethod(Method, ABC):
    """A library's method, which aligns a source cloud to a target cloud."""

    @abstractmethod
    def library(self) -> object:
        """The library.

        Raises:
            DependencyError: If it is missing.
        """

    @abstractmethod
    def aligned(self, source: Array, target: Array, start: Array, size: float) -> Aligned:
        """Align a source (N, 3) to a target (M, 3) [m].

        Args:
            source: Points to be moved.
            target: Points that rest.
            start: T_target_source to set out from, (4, 4).
            size: Of the source [m], by which lengths are scaled.
        """

    def bind(self, body: Body) -> BoundRigidMethod:
        """Nothing is done once, but what cannot be is told.

        Raises:
            ConfigError: If the body has joints, or no surface.
            DependencyError: If the library is missing.
        """
        segments = len(body.skeleton.names)
        if segments > 1:
            raise ConfigError(
                f"method '{self.kind}' is rigid: the template '{body.name}' has {segments} "
                "segments; take a method that moves joints, such as direct"
            )
        if not body.skeleton.free:
            raise ConfigError(
                f"method '{self.kind}' moves a free body: that of '{body.name}' rests"
            )
        if body.surface is None:
            raise ConfigError(
                f"method '{self.kind}' aligns clouds: the template '{body.name}' has no surface"
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
    """A library's method for one body of one segment.

    Attributes:
        method: Its configuration.
        body: The body.
        primitives: The points of its surface.
    """

    method: RigidMethod
    body: Body
    primitives: Primitives

    def register(
        self,
        observation: Observation,
        candidates: Sequence[Pose],
        *,
        prior: Pose | None = None,
        warm_start: RegistrationResult | None = None,
    ) -> RegistrationResult:
        """What the library finds from the best candidate; priors and warm starts are not used.

        Raises:
            DataError: If the library fails, or finds no rigid motion.
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
        """How far the points of the data are from those of the body, against their own spacing."""
        tree = KDTree(transformed(pose.root, self.primitives.centres))
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
            f"method '{kind}' found no rigid motion, but {np.round(transform, 4).tolist()}"
        )
