"""Finalists: poses that are registered by a method, with a search of their limbs, and compared."""

from __future__ import annotations

from dataclasses import dataclass, field

from regkit.body import Body
from regkit.interfaces import Method, Registrar
from regkit.observation import Observation
from regkit.search.limb_recovery import LimbRecovery
from regkit.skeleton import Pose
from regkit.start import Scan
from regkit.start.sizes import misfit

SAMPLES, TRIED, GAIN = 500, 2, 0.01
"""Configurations of each limb that are sampled and registered, and what one must gain."""


@dataclass(frozen=True)
class Finalist:
    """A registered pose.

    Attributes:
        body: The body at a size.
        pose: Its pose.
        energy: Its energy, in the method's own units.
        misfit: Its two-sided misfit, dimensionless.
    """

    body: Body
    pose: Pose
    energy: float
    misfit: float

    @property
    def cost(self) -> float:
        """Energy plus misfit; lower is better."""
        return self.energy + self.misfit


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
        return Finalist(body, found.pose, energy, gap)

    def _bound(self, body: Body) -> tuple[Registrar, LimbRecovery]:
        if body.size not in self.bound:
            registrar = self.method.bind(body)
            self.bound[body.size] = registrar, LimbRecovery.of(registrar, SAMPLES, TRIED, GAIN)
        return self.bound[body.size]
