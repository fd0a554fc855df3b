"""Comparison of poses that are registered by a method, in any size."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from regkit.body import Body
from regkit.interfaces import Method, RegistrationResult
from regkit.observation import Observation
from regkit.search.limb_recovery import LimbRecovery
from regkit.skeleton import Pose
from regkit.start import Finalist
from regkit.system.arrays import Array
from regkit_plugins.starts.exemplars.prior import prior_cost

OTHER = 0.12
"""Poses whose markers differ more than this on average are other ones [size]: 20 cm of a person."""

ALIKE = 0.05
"""Difference in cost by which a pose weighs less by a factor of e in ``mean_pose``.

Of 6 finalists, whose mean was not registered again, the mean error after ``best`` is 2 to 5 % less
than that of the best one alone on 200 hands, 100 people, 120 folded ones and 60 cut-off ones each,
with up to four atlases (development set of ``benchmarks/starts.py``).
"""


@dataclass(frozen=True)
class Comparison:
    """Registers poses and compares their costs.

    Attributes:
        method: The method that registers.
        usual: The template's usual size [m].
        bound: Search of the limbs of the bodies so far, by size.
    """

    method: Method
    usual: float
    bound: dict[float, LimbRecovery] = field(default_factory=dict)

    def finalist(self, body: Body, pose: Pose, observation: Observation) -> Finalist:
        """Returns the pose after registration.

        Args:
            body: The body at a size.
            pose: The pose.
            observation: The frame.
        """
        result = self._limbs(body).registrar.register(observation, [pose])
        return self._compared(body, result, observation)

    def recovered(self, finalist: Finalist, observation: Observation) -> Finalist:
        """Returns a finalist of a frame after a search of all limbs."""
        body = finalist.body
        result = self._limbs(body).recovered(observation, finalist.result)
        return self._compared(body, result, observation)

    def _compared(
        self, body: Body, result: RegistrationResult, observation: Observation
    ) -> Finalist:
        found = Finalist.registered(self._limbs(body), result, observation, self.usual)
        priors = [
            prior_cost(
                body, found.pose.moved(view.to_camera), one_sided=view.data.camera is not None
            )
            for view in observation.views
        ] or [prior_cost(body, found.pose, one_sided=observation.camera is not None)]
        return replace(found, prior=float(np.mean(priors)))

    def registered(self, body: Body, pose: Pose, observation: Observation) -> Pose:
        """Returns the pose after registration alone; the arguments are those of ``finalist``."""
        return self._limbs(body).registrar.register(observation, [pose]).pose

    def _limbs(self, body: Body) -> LimbRecovery:
        if body.size not in self.bound:
            registrar = self.method.bind(body)
            self.bound[body.size] = LimbRecovery.of(registrar)
        return self.bound[body.size]


def mean_pose(finalists: Sequence[Finalist]) -> Pose:
    """Returns the mean of the best pose and those near it that explain the data about as well.

    What the data do not show differs among them, and there the mean has the least expected error.

    Args:
        finalists: The finalists of one body, the best first.
    """
    best, bones = finalists[0], finalists[0].body.skeleton
    near = [one for one in finalists if _apart(one, best) <= OTHER * best.body.size]
    weights = np.exp([(best.cost - one.cost) / ALIKE for one in near])
    steps = np.array([bones.difference(best.pose, one.pose) for one in near])
    return bones.limits.projected(bones.retract(best.pose, weights @ steps / weights.sum()))


def margin(finalists: Sequence[Finalist]) -> float:
    """Returns the cost of the best other pose less that of the best one; NaN without another.

    Args:
        finalists: The finalists, the best first.
    """
    best, *rivals = finalists
    for rival in rivals:
        if _apart(rival, best) > OTHER * best.body.size:
            return rival.cost - best.cost
    return float("nan")


def _apart(one: Finalist, other: Finalist) -> float:
    """Returns the mean distance of the markers of two poses [m]."""
    return float(np.linalg.norm(_markers(one) - _markers(other), axis=1).mean())


def _markers(finalist: Finalist) -> Array:
    return finalist.body.markers.place(finalist.body.place(finalist.pose).transforms)
