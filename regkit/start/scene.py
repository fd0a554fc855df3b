"""A pose of several bodies that move freely, and whose points are whose."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from regkit.body import Body, BodyFit
from regkit.body.each import fits_of_each, points_of_each
from regkit.interfaces import Registrar, Start, Template
from regkit.observation import Observation
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.brief import Brief


@dataclass(frozen=True)
class Scene(Brief):
    """Several bodies, registered together.

    Attributes:
        body: All bodies as one.
        pose: Its pose.
        cost: Its energy and misfit; lower is better.
        misfit: Its two-sided misfit; zero if no body has capsules.
        starts: The start of each body from which it was registered.
    """

    body: Body
    pose: Pose
    cost: float
    misfit: float
    starts: tuple[Start, ...]

    @classmethod
    def of(cls, registrar: Registrar, observation: Observation, starts: Sequence[Start]) -> Self:
        """Registers all bodies together, each from its start.

        Args:
            registrar: The method, bound to all bodies as one.
            observation: The frame.
            starts: The start of each body.
        """
        body = registrar.body
        pose = body.skeleton.rest()
        for one, start in zip(body.free_bodies, starts, strict=True):
            pose = one.placed(start.pose, pose)
        pose = registrar.register(observation, [pose]).pose
        return cls.at(registrar, observation, pose, starts)

    @classmethod
    def at(
        cls, registrar: Registrar, observation: Observation, pose: Pose, starts: Sequence[Start]
    ) -> Self:
        """Returns the scene of a registered pose; the other arguments are those of ``of``."""
        fit = BodyFit.of(registrar.body, pose, observation.points, observation.sight)
        energy = registrar.evaluate(observation, pose).energy
        # Bodies without capsules have an energy alone.
        misfit = fit.misfit if np.isfinite(fit.misfit) else 0.0
        return cls(registrar.body, pose, energy + misfit, misfit, tuple(starts))

    def owned(self, observation: Observation) -> tuple[NDArray[np.bool_], ...]:
        """Returns the points of each body: those that are nearest to it, and not far away."""
        return points_of_each(self.body, self.pose, observation.points)

    def misfits(self, observation: Observation) -> Array:
        """Returns the misfit of each body to its own points, (K,); infinite if it is unknown."""
        fits = fits_of_each(self.body, self.pose, observation.points, observation.sight)
        return np.nan_to_num([one.misfit for one in fits], nan=np.inf)

    def exchanges(self, other: Scene, templates: Sequence[Template]) -> bool:
        """Returns whether a body is where another one is in the other scene.

        Args:
            other: The other scene.
            templates: The template of each body; bodies of equal ones are alike.
        """
        apart = np.linalg.norm(self._middles[:, None] - other._middles, axis=2)
        nearest = enumerate(apart.argmin(axis=1).tolist())
        return any(templates[at] != templates[there] for at, there in nearest)

    @cached_property
    def _middles(self) -> Array:
        """The middle of each body, (K, 3) [m]."""
        transforms = self.body.place(self.pose).transforms
        return np.array(
            [transforms[one.segments, :3, 3].mean(axis=0) for one in self.body.free_bodies]
        )
