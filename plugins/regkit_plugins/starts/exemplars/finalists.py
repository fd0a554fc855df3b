"""Finalists: poses that are registered by a method, with a search of their limbs, and compared."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from regkit.body import Body
from regkit.interfaces import Method, Registrar
from regkit.observation import Observation
from regkit.search.limb_recovery import LimbRecovery
from regkit.skeleton import Pose
from regkit.start import Scan
from regkit.start.sizes import misfit
from regkit.system.arrays import Array
from regkit_plugins.starts.exemplars.prior import unlikely

SAMPLES, TRIED, GAIN = 500, 2, 0.01
"""Configurations of each limb that are sampled and registered, and what one must gain."""


OTHER = 0.12
"""Poses whose markers differ more than this on average are other ones [size]: 20 cm of a person."""


@dataclass(frozen=True)
class Finalist:
    """A registered pose.

    Attributes:
        body: The body at a size.
        pose: Its pose.
        energy: Its energy, in the method's own units.
        misfit: Its two-sided misfit, dimensionless.
        unlikely: Cost of the pose without regard to the data, dimensionless.
    """

    body: Body
    pose: Pose
    energy: float
    misfit: float
    unlikely: float

    @property
    def cost(self) -> float:
        """Energy, misfit and prior; lower is better."""
        return self.energy + self.misfit + self.unlikely


@dataclass(frozen=True)
class Comparison:
    """Registers poses and compares their costs.

    Attributes:
        method: The method that registers.
        usual: The template's usual size [m].
        bound: Registrar and search of limbs of the bodies so far, by size.
    """

    method: Method
    usual: float
    bound: dict[float, tuple[Registrar, LimbRecovery]] = field(default_factory=dict)

    def finalist(self, body: Body, pose: Pose, observation: Observation, scan: Scan) -> Finalist:
        """Returns the pose after registration and a search of all limbs.

        Args:
            body: The body at a size.
            pose: The pose.
            observation: The frame.
            scan: Its cloud.
        """
        registrar, limbs = self._bound(body)
        found = registrar.register(observation, [pose])
        found = limbs.recovered(observation, found)
        energy = registrar.evaluate(observation, found.pose).energy
        gap = misfit(scan, body, found.pose, self.usual)
        prior = unlikely(body, found.pose, observation.camera is not None)
        return Finalist(body, found.pose, energy, gap, prior)

    def _bound(self, body: Body) -> tuple[Registrar, LimbRecovery]:
        if body.size not in self.bound:
            registrar = self.method.bind(body)
            self.bound[body.size] = registrar, LimbRecovery.of(registrar, SAMPLES, TRIED, GAIN)
        return self.bound[body.size]


def margin(finalists: Sequence[Finalist]) -> float:
    """Returns the cost of the best other pose less that of the best one; NaN without another.

    Args:
        finalists: The finalists, the best first.
    """
    best, *rivals = finalists
    places = _markers(best)
    for rival in rivals:
        apart = float(np.linalg.norm(_markers(rival) - places, axis=1).mean())
        if apart > OTHER * best.body.size:
            return rival.cost - best.cost
    return float("nan")


def _markers(finalist: Finalist) -> Array:
    return finalist.body.markers.place(finalist.body.place(finalist.pose).transforms)
