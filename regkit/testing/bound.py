"""A kernel bound to data about a posed body, on which its laws are tried."""

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
    """A kernel bound to data about a posed body.

    Attributes:
        pair: The kernel and the shape.
        body: The body.
        start: Its pose.
        primitives: What the shape made of it.
        data: The data.
    """

    pair: Pair
    body: Body
    start: Pose
    primitives: Primitives
    data: Observation

    @classmethod
    def near(cls, pair: Pair, body: Body, random: np.random.Generator) -> Bound:
        """With noisy, uneven data before a camera."""
        start = posed(body, random)
        data = data_of(body, start, random)
        return cls(pair, body, start, attached(pair.shape, body), data)

    @property
    def kernel(self) -> Kernel:
        """The kernel."""
        return cast(Kernel, self.pair.plugin)

    def placed(self, pose: Pose | None = None) -> Placed[Primitives]:
        """The primitives in a pose; without one, at the start."""
        return self.primitives.place(self.body.place(pose or self.start).transforms)

    def similarity(self, smoothing: float = 0.0) -> Similarity:
        """The kernel against the data."""
        return self.kernel.bind(self.data, self.placed(), smoothing=smoothing)

    def problem(self, smoothing: float = 0.0) -> RegistrationProblem:
        """The energy on the degrees of freedom."""
        chart = TangentCoordinates(self.body.skeleton, self.start)
        return RegistrationProblem(chart, self.primitives, {"kernel": self.similarity(smoothing)})

    def near_start(self, random: np.random.Generator, by: float = 0.05) -> Array:
        """A point about the start, where nothing is special."""
        return np.asarray(by * random.normal(size=self.body.skeleton.dofs))

    def moved(self, motion: Array) -> Bound:
        """The same after a rigid motion of the body and the data."""
        return replace(
            self, start=moved_pose(self.start, motion), data=moved_data(self.data, motion)
        )

    @property
    def answer(self) -> object:
        """The method that answers, where the kernel's author should look."""
        similarity = type(self.similarity())
        if issubclass(similarity, ResidualSimilarity):
            inherited = similarity.__call__ is ResidualSimilarity.__call__
            return similarity.residuals if inherited else similarity.__call__
        return similarity.__call__
