"""One resolution of the method with its data: rounds of pairing and minimising, for any body."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.interfaces import Kernel, Problem, Similarity
from regkit.observation import Observation
from regkit.primitives import Gaussians, Placed
from regkit.registration import RegistrationProblem, TangentCoordinates
from regkit.skeleton import Pose
from regkit.system.arrays import Array


class Round(ABC):
    """The problem with the pairs of one pose.

    Attributes:
        problem: The problem, which starts at that pose.
    """

    problem: Problem

    @abstractmethod
    def pose(self, x: Array) -> Pose:
        """Returns the pose at coordinates x (m,)."""

    @abstractmethod
    def inlier_probability(self, pose: Pose) -> Array | None:
        """Returns the inlier probability of each point, (N,); None if it is unknown."""


class Stage(ABC):
    """A body's Gaussians at one resolution, bound to the data at the same resolution."""

    @abstractmethod
    def round(self, pose: Pose) -> Round:
        """Returns the problem with the pairs of a pose."""

    @abstractmethod
    def distance(self, first: Pose, second: Pose) -> float:
        """Returns the root mean square distance [m] of the Gaussians between two poses."""


@dataclass(frozen=True)
class GeneralStage(Stage):
    """A stage of any kernel and body.

    Attributes:
        kernel: The kernel.
        body: The body.
        primitives: Its Gaussians.
        data: The data.
    """

    kernel: Kernel
    body: Body
    primitives: Gaussians
    data: Observation

    def round(self, pose: Pose) -> GeneralRound:
        """Returns the problem with the kernel bound to the data in a pose."""
        placed = self.placed(pose)
        similarity = self.kernel.bind(self.data, placed)
        coordinates = TangentCoordinates(self.body.skeleton, pose)
        problem = RegistrationProblem(coordinates, self.primitives, {"kernel": similarity})
        return GeneralRound(self, similarity, coordinates, problem)

    def distance(self, first: Pose, second: Pose) -> float:
        """Returns the root mean square distance [m] of the Gaussians between two poses."""
        apart = self.placed(second).centres - self.placed(first).centres
        return float(np.sqrt((apart**2).sum(axis=1).mean()))

    def placed(self, pose: Pose) -> Placed[Gaussians]:
        """Returns the Gaussians in a pose."""
        return self.primitives.place(self.body.place(pose).transforms)


@dataclass(frozen=True)
class GeneralRound(Round):
    """A round of any kernel and body.

    Attributes:
        stage: The stage.
        similarity: The kernel, bound to the data.
        coordinates: Coordinates around the start pose.
        problem: The problem.
    """

    stage: GeneralStage
    similarity: Similarity
    coordinates: TangentCoordinates
    problem: RegistrationProblem

    def pose(self, x: Array) -> Pose:
        """Returns the pose at coordinates x (m,)."""
        return self.coordinates.pose(x)

    def inlier_probability(self, pose: Pose) -> Array | None:
        """Returns the inlier probability of each point, (N,); None if it is unknown."""
        return self.similarity.inlier_probability(self.stage.placed(pose))
