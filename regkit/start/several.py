"""The start of several bodies that move freely beside each other."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import permutations
from operator import attrgetter

import numpy as np
from numpy.typing import NDArray

from regkit.interfaces import Method, Registrar, Start, Template
from regkit.observation import Observation
from regkit.search.limb_recovery import LimbRecovery
from regkit.start.divisions import Division, divisions
from regkit.start.of_size import OfSize
from regkit.start.scene import Scene
from regkit.system.errors import ConfigError

Find = Callable[[Template, Sequence[Observation]], Start]
"""Search of one body."""

FEWEST = 20
"""Fewer points show no body."""

JOINTLY = 2
"""Number of assignments of bodies to the parts of a division that are registered together."""

CLEAR = 0.35
"""Pieces with a smaller misfit are the bodies.

Chosen on frames of two hands, and of a hand with a can: 0.31 at most where the pieces are the
bodies, 0.43 at least where another body is cut in two.
"""

NEARLY = 0.3
"""Where they are, other assignments count only if they cost at most this much more."""


@dataclass(frozen=True)
class SeveralSearch:
    """Seeks several bodies of known sizes in a frame.

    Attributes:
        find: Search of one body.
        templates: The template of each body, at its size.
        method: The method that registers.
        registrar: The method, bound to all bodies as one.
        observation: The frame.
        found: The starts of single bodies so far and their costs, by body and points.
    """

    find: Find
    templates: tuple[Template, ...]
    method: Method
    registrar: Registrar
    observation: Observation
    found: dict[tuple[int, bytes], tuple[Start, float]] = field(default_factory=dict)

    @classmethod
    def of(
        cls, find: Find, template: Template, size: float, method: Method, observation: Observation
    ) -> SeveralSearch:
        """Returns the search of a template's bodies at the size of the whole [m].

        Raises:
            ConfigError: If a body has nothing that the method can register.
        """
        whole = template.body(size)
        registrar = method.bind(whole)
        for one in whole.free_bodies:
            if not np.isin(registrar.primitives.segments, one.segments).any():
                raise ConfigError(
                    f"'{one.name}' has no primitives for the method that registers all bodies; "
                    "bodies beside each other need capsules, as a file template has, or a list of "
                    "primitives for its shape model"
                )
        templates = [
            OfSize(template=one, size=free.body.size) if one.given_size() is None else one
            for one, free in zip(template.free_bodies().values(), whole.free_bodies, strict=True)
        ]
        return cls(find, tuple(templates), method, registrar, observation)

    def scenes(self) -> list[Scene]:
        """Returns the best scene, and the best one whose bodies are exchanged, if there is one.

        Without a division that gives each body some points, there is no scene.
        """
        found: list[Scene] = []
        for division in divisions(self.observation.points, len(self.templates)):
            new = self.of_division(division)
            known = [tuple(map(id, one.starts)) for one in found]
            found += [one for one in new if tuple(map(id, one.starts)) not in known]
            # Where pieces clearly are the bodies, none has to be cut.
            if not division.cut and any(one.misfit < CLEAR for one in found):
                break
        return self.contest(found)

    def contest(self, found: Sequence[Scene]) -> list[Scene]:
        """Returns what ``scenes`` returns, of all scenes.

        Those that do not cost much more than the best are refined before they are compared, since
        their bodies have points of others still.
        """
        least = min((one.cost for one in found), default=0.0)
        clear = any(one.misfit < CLEAR for one in found)
        near = NEARLY if clear else np.inf
        tried = [self.refined(one) if one.cost < least + near else one for one in found]
        tried.sort(key=attrgetter("cost"))
        chosen = [self.with_limbs(self.with_rivals(one)) for one in tried[:1]]
        chosen += [one for one in tried if one.exchanges(chosen[0], self.templates)][:1]
        return sorted(chosen, key=attrgetter("cost"))

    def of_division(self, division: Division) -> list[Scene]:
        """Returns the scenes in which each body has a part of a division for itself.

        The assignments are compared by the costs of the single bodies; the best are registered.
        """
        parts = [one for one in division.parts if one.sum() >= FEWEST]
        each = range(len(self.templates))
        if len(parts) < len(each):
            return []
        alone = [[self.alone(at, part) for part in parts] for at in each]
        orders = sorted(
            permutations(range(len(parts)), len(each)),
            key=lambda order: sum(alone[at][order[at]][1] for at in each),
        )
        return [
            Scene.of(self.registrar, self.observation, [alone[at][order[at]][0] for at in each])
            for order in orders[:JOINTLY]
        ]

    def refined(self, scene: Scene) -> Scene:
        """Returns a better scene, with bodies sought anew among the points nearest to them.

        The body that fits worst is sought first, since its points may be those of another.
        """
        for at in np.argsort(-scene.misfits(self.observation)).tolist():
            own = scene.owned(self.observation)[at]
            if own.sum() >= FEWEST:
                start = self.alone(at, own)[0]
                scene = min(scene, self._with(scene, at, start), key=attrgetter("cost"))
        return scene

    def with_rivals(self, scene: Scene) -> Scene:
        """Returns a scene with other poses of its bodies, if it is better.

        With the points of the others at hand, another pose than the best one alone may be right.
        """
        for at, start in enumerate(scene.starts):
            for pose in start.rivals:
                tried = self._with(scene, at, replace(start, pose=pose))
                scene = min(scene, tried, key=attrgetter("cost"))
        return scene

    def with_limbs(self, scene: Scene) -> Scene:
        """Returns a scene after a search of all limbs, if it is better."""
        result = self.registrar.register(self.observation, [scene.pose])
        result = LimbRecovery.of(self.registrar).recovered(self.observation, result)
        found = Scene.at(self.registrar, self.observation, result.pose, scene.starts)
        return min(scene, found, key=attrgetter("cost"))

    def alone(self, at: int, part: NDArray[np.bool_]) -> tuple[Start, float]:
        """Returns the start of a body alone in a part of the points, and its cost."""
        key = at, part.tobytes()
        if key not in self.found:
            seen = self.observation.only(part)
            start = self.find(self.templates[at], [seen])
            scene = Scene.at(self._registrars[at], seen, start.pose, [start])
            self.found[key] = start, scene.cost
        return self.found[key]

    def _with(self, scene: Scene, at: int, start: Start) -> Scene:
        """Returns a scene after one of its bodies got another start, registered."""
        pose = scene.body.free_bodies[at].placed(start.pose, scene.pose)
        pose = self.registrar.register(self.observation, [pose]).pose
        starts = [start if index == at else one for index, one in enumerate(scene.starts)]
        return Scene.at(self.registrar, self.observation, pose, starts)

    @cached_property
    def _registrars(self) -> list[Registrar]:
        """The method, bound to each body alone."""
        return [self.method.bind(one.body) for one in self.registrar.body.free_bodies]
