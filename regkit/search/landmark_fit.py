"""Poses that bring the markers to their landmarks, from starts that may be far off."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from regkit.body import Body
from regkit.geometry.rotation import vector_to_matrix
from regkit.observation import Observation
from regkit.registration.landmarks import WEIGHT, LandmarkEnergy, landmark_table
from regkit.registration.landmarks.table import FOCAL, SEGMENT, TARGET
from regkit.registration.robust import GemanMcClure
from regkit.registration.tangent import TangentCoordinates
from regkit.skeleton import Pose
from regkit.system.arrays import Array, Indices

SCALES = (12.0, 4.0, 1.0)
"""Scales of the loss in units of the landmarks' errors, one fit after the other: from all landmarks
to the inliers."""

STEPS = 8
"""Number of damped Gauss-Newton steps at each scale."""

DAMPING = (1e-2, 1e-1)
"""Weights of a step of the root and of a joint [rad] against a landmark at its error."""

TURNS = 4
"""Number of turns of a start about the body's own y axis."""


@dataclass(frozen=True)
class LandmarkFit:
    """Fits poses to the landmarks of a frame.

    Attributes:
        body: The body.
        energy: The energy of its landmarks at their errors.
    """

    body: Body
    energy: LandmarkEnergy

    @classmethod
    def of(cls, body: Body, observation: Observation) -> LandmarkFit | None:
        """Returns the fit of a frame; None if none of the body's markers is measured."""
        if observation.landmarks is None:
            return None
        table = landmark_table(body, observation)
        table = table[table[:, WEIGHT] > 0.0]
        if not len(table):
            return None
        return cls(body, LandmarkEnergy(body.skeleton, table, GemanMcClure(1.0)))

    def of_segments(self, segments: Indices) -> LandmarkFit:
        """Returns the fit of the landmarks on some segments."""
        table = self.energy.table
        own = table[np.isin(table[:, SEGMENT], segments)]
        return replace(self, energy=replace(self.energy, table=own))

    def sizes(self, pose: Pose) -> Array:
        """Returns the distances of the markers to their landmarks, (..., L), as in the energy."""
        return self.energy.sizes(pose)

    def cost(self, pose: Pose) -> Array:
        """Returns the robust sum of these distances, (...)."""
        weights = self.energy.table[:, WEIGHT]
        return np.asarray(self.energy.loss.values(self.sizes(pose)) @ weights)

    def turned(self, pose: Pose) -> list[Pose]:
        """Returns fits of a pose whose body is turned about its own y axis, the best first."""
        if not self.body.skeleton.free:
            return [self.fitted(pose)]
        found = [self.fitted(self._over(one)) for one in _turns(pose)]
        return sorted(found, key=self.cost)

    def fitted(self, pose: Pose, scales: Iterable[float] = SCALES) -> Pose:
        """Returns the pose of least energy near a pose, from a wide loss to a narrow one."""
        for scale in scales:
            pose = self._settled(replace(self.energy, loss=GemanMcClure(scale)), pose)
        return pose

    def _over(self, pose: Pose) -> Pose:
        """Returns a pose moved so that the medians of markers and landmarks in space agree."""
        space = self.energy.table[:, FOCAL] == 0.0
        if not space.any():
            return pose
        places = self.energy.places(pose)[space]
        shift = np.median(self.energy.table[space, TARGET : TARGET + 3] - places, axis=0)
        root = pose.root.copy()
        root[:3, 3] += shift
        return Pose(root, pose.balls, pose.hinges)

    def _settled(self, energy: LandmarkEnergy, pose: Pose) -> Pose:
        """Returns the pose after damped Gauss-Newton steps, within the joint limits."""
        skeleton, factor = self.body.skeleton, 1.0
        damping = np.full(skeleton.dofs, DAMPING[1])
        damping[skeleton.free_dofs] = DAMPING[0]
        response = energy(pose)
        for _ in range(STEPS):
            chart = TangentCoordinates(skeleton, pose)
            jacobian = chart.jacobian(chart.origin())
            # The wider the loss, the less a landmark weighs.
            stiffness = response.stiffness + np.diag(factor * damping / energy.loss.scale**2)
            step = np.linalg.solve(jacobian.T @ stiffness @ jacobian, -jacobian.T @ response.force)
            tried = skeleton.limits.projected(chart.pose(np.asarray(step)))
            new = energy(tried)
            if new.energy < response.energy:
                gain = response.energy - new.energy
                pose, response, factor = tried, new, 0.3 * factor
                if gain < 1e-3 * response.energy:
                    break
            else:
                factor *= 10.0
        return pose


def _turns(pose: Pose) -> list[Pose]:
    turns = []
    for index in range(TURNS):
        root = pose.root.copy()
        angle = 2.0 * np.pi * index / TURNS
        root[:3, :3] = root[:3, :3] @ vector_to_matrix(np.array([0.0, angle, 0.0]))
        turns.append(Pose(root, pose.balls, pose.hinges))
    return turns
