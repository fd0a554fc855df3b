"""The coarse-to-fine method bound to a body, which follows starts from resolution to resolution."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from regkit.body import Body
from regkit.clouds.tree import Tree
from regkit.interfaces import Evaluation, Prior, Registrar, RegistrationResult
from regkit.observation import Observation
from regkit.primitives import Gaussians
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.threads import using_threads
from regkit_plugins.methods.coarse_to_fine.resolutions import (
    Resolution,
    observations,
    sorted_observation,
)
from regkit_plugins.methods.coarse_to_fine.rigid_stage import RigidStage
from regkit_plugins.methods.coarse_to_fine.stages import GeneralStage, Round, Stage

if TYPE_CHECKING:
    from regkit_plugins.methods.coarse_to_fine.coarse_to_fine import CoarseToFine


@dataclass(frozen=True)
class _Progress:
    """A start at some resolution: its pose, and the effort and outcome so far.

    Attributes:
        pose: The pose.
        energy: Its energy at the last resolution.
        round: The last round; None before the first.
        converged: Whether the motion converged at the last resolution.
        iterations: Number of steps of the solver.
        evaluations: Number of evaluations of the energy.
    """

    pose: Pose
    energy: float = np.nan
    round: Round | None = None
    converged: bool = False
    iterations: int = 0
    evaluations: int = 0


@dataclass(frozen=True)
class BoundCoarseToFine(Registrar):
    """``CoarseToFine`` bound to a body.

    Attributes:
        method: The method.
        body: The body.
        primitives: Gaussians of the body at the finest resolution.
        levels: The resolutions, the coarsest first.
    """

    method: CoarseToFine
    body: Body
    primitives: Gaussians
    levels: tuple[Resolution, ...]

    def register(
        self,
        observation: Observation,
        candidates: Sequence[Pose],
        *,
        prior: Prior | None = None,
        warm_start: RegistrationResult | None = None,
    ) -> RegistrationResult:
        """Minimises the energy from the best candidate, resolution by resolution.

        A prior and a warm start have no effect, because the data determine every motion.
        """
        with using_threads(self.method.threads):
            data = observations(observation, self.levels)
            pose = candidates[0]
            if len(candidates) > 1:
                first = self._stage(self.levels[0], data[0])
                pose = min(candidates, key=lambda one: _energy(first, one))
            return self._registered(self.levels, data, [pose])[0]

    def register_each(
        self, observation: Observation, starts: Sequence[Pose], *, accuracy: float = np.inf
    ) -> list[RegistrationResult]:
        """Minimises the energy from each start; those that have met are followed only once.

        Resolutions whose voxels are larger than the accuracy [m] of the starts are left out: where
        the clouds overlap in part only, wide Gaussians would pull them away from a good start.
        """
        with using_threads(self.method.threads):
            levels = tuple(level for level in self.levels if level.voxel <= accuracy)
            levels = levels or self.levels[-1:]
            return self._registered(levels, observations(observation, levels), starts)

    def evaluate(self, observation: Observation, pose: Pose) -> Evaluation:
        """Returns the energy at the finest resolution, with the neighbours in the given pose."""
        with using_threads(self.method.threads):
            tree = Tree.of(observation.points)
            last = self.levels[-1]
            stage = self._stage(last, sorted_observation(tree, last))
            probability = _known(stage.round(pose).inlier_probability(pose))
            if len(probability) == len(tree):
                probability[tree.order] = probability.copy()
            return Evaluation(_energy(stage, pose), probability)

    def _registered(
        self,
        levels: Sequence[Resolution],
        data: Sequence[Observation],
        starts: Sequence[Pose],
    ) -> list[RegistrationResult]:
        """Returns one result for each start, from data at some resolutions."""
        followed = [_Progress(pose) for pose in starts]
        place = np.arange(len(starts))
        for level, downsampled in zip(levels, data, strict=True):
            stage = self._stage(level, downsampled)
            within = self.method.motion_tolerance * level.voxel
            ended: list[_Progress] = []
            moved = np.empty(len(followed), dtype=np.intp)
            for index, progress in enumerate(followed):
                end = self._minimized(stage, progress, within)
                met = [stage.distance(one.pose, end.pose) <= within for one in ended]
                moved[index] = [*met, True].index(True)
                if moved[index] == len(ended):
                    ended.append(end)
            followed, place = ended, moved[place]
        results = [self._result(progress) for progress in followed]
        return [results[index] for index in place]

    def _minimized(self, stage: Stage, progress: _Progress, within: float) -> _Progress:
        """Returns a start after rounds of pairing and minimising, until it moves no farther.

        Args:
            stage: The resolution.
            progress: The start.
            within: Root mean square motion of the body's points at which it ends [m].
        """
        iterations, evaluations = progress.iterations, progress.evaluations
        pose, converged = progress.pose, False
        for _ in range(self.method.searches):
            current = stage.round(pose)
            solution = self.method.solver.minimize(current.problem)
            before, pose = pose, current.pose(solution.x)
            iterations += solution.iterations
            evaluations += solution.evaluations
            converged = stage.distance(before, pose) <= within
            if converged:
                break
        return _Progress(pose, solution.value, current, converged, iterations, evaluations)

    def _result(self, progress: _Progress) -> RegistrationResult:
        assert progress.round is not None
        inliers = _known(progress.round.inlier_probability(progress.pose))
        return RegistrationResult(
            pose=progress.pose,
            energy=progress.energy,
            inlier_share=Evaluation(progress.energy, inliers).inlier_share,
            converged=progress.converged,
            iterations=progress.iterations,
            evaluations=progress.evaluations,
            message="the motion converged"
            if progress.converged
            else f"no convergence in {self.method.searches} searches",
        )

    def _stage(self, level: Resolution, data: Observation) -> Stage:
        skeleton = self.body.skeleton
        if len(skeleton.names) == 1 and skeleton.free:
            comparison = self.method.kernel.bind_rigid(data, level.primitives)
            if comparison is not None:
                return RigidStage(comparison, level.primitives.centres)
        return GeneralStage(self.method.kernel, self.body, level.primitives, data)


def _energy(stage: Stage, pose: Pose) -> float:
    """Returns the energy with the pairs of a pose."""
    problem = stage.round(pose).problem
    return problem.value_and_gradient(problem.start)[0]


def _known(inlier_probability: Array | None) -> Array:
    """Returns the inlier probability of each point; NaN if the kernel does not provide it."""
    return np.array([np.nan]) if inlier_probability is None else inlier_probability
