"""A kernel bound to data near a posed body, for the tests of its laws."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import cast

import numpy as np

from regkit.body import Body
from regkit.interfaces import Kernel, Similarity
from regkit.observation import Observation
from regkit.primitives import Placed, Primitives
from regkit.registration import RegistrationProblem, ResidualSimilarity, TangentCoordinates
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.testing.cases import Pair
from regkit.testing.samples import data_of, moved_data, moved_pose, posed
from regkit.testing.shape_laws import attached


@dataclass(frozen=True)
class Bound:
    """A kernel bound to data near a posed body.

    Attributes:
        pair: The kernel and the shape.
        body: The body.
        start: Its pose.
        primitives: Primitives of the shape on the body.
        data: The data.
    """

    pair: Pair
    body: Body
    start: Pose
    primitives: Primitives
    data: Observation

    @classmethod
    def near(cls, pair: Pair, body: Body, random: np.random.Generator) -> Bound:
        """Returns the kernel bound to noisy data of uneven weights, seen by a camera."""
        start = posed(body, random)
        data = data_of(body, start, random)
        return cls(pair, body, start, attached(pair.shape, body), data)

    @property
    def kernel(self) -> Kernel:
        """The kernel."""
        return cast(Kernel, self.pair.plugin)

    def placed(self, pose: Pose | None = None) -> Placed[Primitives]:
        """Returns the primitives in a pose; by default in the start."""
        return self.primitives.place(self.body.place(pose or self.start).transforms)

    def similarity(self, smoothing: float = 0.0) -> Similarity:
        """Returns the kernel bound to the data."""
        return self.kernel.bind(self.data, self.placed(), smoothing=smoothing)

    def problem(self, smoothing: float = 0.0) -> RegistrationProblem:
        """Returns the registration problem on the degrees of freedom."""
        chart = TangentCoordinates(self.body.skeleton, self.start)
        return RegistrationProblem(chart, self.primitives, {"kernel": self.similarity(smoothing)})

    def near_start(self, random: np.random.Generator, by: float = 0.05) -> Array:
        """Returns a random point (n,) near the start."""
        return np.asarray(by * random.normal(size=self.body.skeleton.dofs))

    def moved(self, motion: Array) -> Bound:
        """Returns body and data after a common rigid motion (4, 4)."""
        return replace(
            self, start=moved_pose(self.start, motion), data=moved_data(self.data, motion)
        )

    @property
    def answer(self) -> object:
        """The method that computes the response, for the author to look at."""
        similarity = type(self.similarity())
        if issubclass(similarity, ResidualSimilarity):
            inherited = similarity.__call__ is ResidualSimilarity.__call__
            return similarity.residuals if inherited else similarity.__call__
        return similarity.__call__
