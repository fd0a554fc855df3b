"""What a calibration finds of a subject: proportions, or coefficients of shape modes."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy

from regkit.body import Body, BodyDescription
from regkit.body.linear_shape import LinearShape
from regkit.body.proportions import Proportions
from regkit.body.shaped import shaped
from regkit.calibration.frames import Looks, distances
from regkit.calibration.problem import SubjectProblem
from regkit.calibration.shape import Shape
from regkit.calibration.skin import MeasuredFrame, fitted, measured, skin_distances
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interfaces import Solver
from regkit.system.arrays import Array
from regkit.system.errors import NotFoundError

EXTREME = 1.25
"""A fit has failed if a bone's length differs by more than this factor from the scaled template."""

RAREST = 1e-12
"""Probability of a shape that is refused. Clothes, hair and proportions that the modes do not show
make people rarer than they are."""

FARTHEST = 0.015
"""A fit has failed if the median distance of the data exceeds this fraction of the body's size."""

NOISE = 0.005
"""Noise alone may put the data this far from the surface [m], which is much of a small body."""

ADVICE = "the body was not found; give its size or a start, or use another recording"


@dataclass(frozen=True)
class Changes:
    """A table of what a shape changes.

    Attributes:
        title: What the numbers are.
        columns: Names of the columns.
        rows: The cells.
    """

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


def changed_proportions(proportions: Proportions, scale: float) -> Changes:
    """Returns the table of proportions, relative to the template times a scale."""
    factors = zip(proportions.groups.names, proportions.lengths, proportions.girths, strict=True)
    rows = (
        (name, f"{length / scale:.2f}", f"{girth / scale:.2f}") for name, length, girth in factors
    )
    title = "relative to the template at this size"
    return Changes(title, ("segments", "length", "girth"), tuple(rows))


class SubjectShape(ABC):
    """A template whose shape is a vector x (P,) that a calibration finds."""

    template: BodyDescription

    @classmethod
    def of(cls, template: BodyDescription) -> SubjectShape:
        """Returns the coefficients of a template with shape modes, else its proportions.

        Raises:
            ConfigError: If the template lists a shape model that cannot be loaded.
            DataError: If its mesh or its modes cannot be read, or do not belong together.
        """
        template.check_shapes()
        if template.modes is None:
            return ProportionShape(template)
        return ModeShape(template)

    @abstractmethod
    def origin(self, size: float) -> Array:
        """Returns the shape (P,) of a body of which only the size [m] is known."""

    @abstractmethod
    def description(self, x: Array) -> BodyDescription:
        """Returns the template with a shape (P,)."""

    @abstractmethod
    def skin(self, x: Array) -> SkinnedMesh | None:
        """Returns the template's mesh with a shape (P,); None without a mesh."""

    @abstractmethod
    def fitted(self, x: Array, looks: Looks, solver: Solver) -> tuple[Array, Looks]:
        """Returns shape (P,) and poses that fit the data of the frames best."""

    @abstractmethod
    def gaps(self, x: Array, looks: Looks) -> Array:
        """Returns the distances of the points of all frames to the surface, (N,) [m]."""

    @abstractmethod
    def check(self, x: Array) -> None:
        """Checks that a shape (P,) is plausible.

        Raises:
            NotFoundError: If it is not.
        """

    @abstractmethod
    def changes(self, x: Array) -> Changes:
        """Returns a table of what a shape (P,) changes."""

    def body(self, x: Array) -> Body:
        """Returns the body with a shape (P,)."""
        subject = self.description(x)
        return subject.body("subject", subject.size.value)


@dataclass(frozen=True)
class ProportionShape(SubjectShape):
    """Lengths and girths of the segments of a template without shape modes."""

    template: BodyDescription

    def origin(self, size: float) -> Array:
        """Returns the template's own proportions at a size [m]."""
        return self._shape.origin(size)

    def description(self, x: Array) -> BodyDescription:
        """Returns the template with the proportions x (1 + 2 G)."""
        return self._shape.description(x)

    def skin(self, x: Array) -> SkinnedMesh | None:
        """Returns the template's mesh with the proportions x (1 + 2 G)."""
        return self._shape.proportions(x).skin(self.template)

    def fitted(self, x: Array, looks: Looks, solver: Solver) -> tuple[Array, Looks]:
        """Returns proportions and poses with the least distances of the capsules."""
        problem = SubjectProblem(self._shape, x, looks.clouds, looks.poses)
        solution = solver.minimize(problem)
        return problem.shape(solution.x), replace(looks, poses=problem.poses(solution.x))

    def gaps(self, x: Array, looks: Looks) -> Array:
        """Returns the distances of the points to the capsules, (N,) [m]."""
        return distances(self.body(x), looks)

    def check(self, x: Array) -> None:
        """Refuses a bone of extreme length."""
        names = self._shape.groups.names
        lengths = x[1 : 1 + len(names)]
        worst = int(np.abs(lengths).argmax())
        if abs(lengths[worst]) > np.log(EXTREME):
            raise NotFoundError(
                f"'{names[worst]}' came out {np.exp(lengths[worst]):.2f} times as long as in the "
                f"scaled template: {ADVICE}"
            )

    def changes(self, x: Array) -> Changes:
        """Returns the factors of lengths and girths, relative to the template at this size."""
        scale = self.description(x).size.value / self.template.size.value
        return changed_proportions(self._shape.proportions(x), scale)

    @property
    def _shape(self) -> Shape:
        return Shape(self.template)


@dataclass(frozen=True)
class ModeShape(SubjectShape):
    """Coefficients of a template's shape modes, with lengths and girths beside them."""

    template: BodyDescription

    @cached_property
    def shape(self) -> LinearShape:
        """The template's shape as a function of the coefficients."""
        return LinearShape.of(self.template)

    def origin(self, size: float) -> Array:
        """Returns the most probable coefficients (P,) of a size [m]."""
        return self.shape.at_size(size)

    def description(self, x: Array) -> BodyDescription:
        """Returns the template with the coefficients x (P,)."""
        return shaped(self.shape, x)

    def skin(self, x: Array) -> SkinnedMesh:
        """Returns the template's mesh with the coefficients x (P,)."""
        return self.shape.skin(x)

    def fitted(self, x: Array, looks: Looks, solver: Solver) -> tuple[Array, Looks]:
        """Returns coefficients and poses with the least distances of the skin."""
        found = fitted(self.shape, x, _measured(looks), looks.poses, solver)
        return found.coefficients, replace(looks, poses=found.poses)

    def gaps(self, x: Array, looks: Looks) -> Array:
        """Returns the distances of the points to the skin, (N,) [m]."""
        return np.abs(skin_distances(self.shape, x, _measured(looks), looks.poses))

    def check(self, x: Array) -> None:
        """Refuses a shape that is farther from the mean than any person is."""
        away = self.shape.energy(x)
        largest = 0.5 * float(scipy.stats.chi2.isf(RAREST, len(x)))
        if away > largest:
            raise NotFoundError(
                f"its shape came out {np.sqrt(2.0 * away):.1f} standard deviations from the mean "
                f"of the template's modes, and {np.sqrt(2.0 * largest):.1f} are plausible: {ADVICE}"
            )

    def changes(self, x: Array) -> Changes:
        """Returns the coefficients of the modes, from the mean and in standard deviations."""
        spread = np.sqrt(np.diag(np.linalg.inv(self.shape.information)))
        away = (x - self.shape.mean) / spread
        modes = self.shape.modes
        rows = (
            (name, f"{one:+.2f}", f"{far:+.2f}")
            for name, one, far in zip(self.shape.names[:modes], x, away, strict=False)
        )
        title = "coefficients of the shape modes, and how far they are from the mean"
        return Changes(title, ("mode", "coefficient", "deviations"), tuple(rows))


def check_distance(off: float, size: float) -> None:
    """Refuses a fit whose surface is far from the data.

    Args:
        off: Median distance of the data to the surface [m].
        size: The body's size [m].

    Raises:
        NotFoundError: If it is.
    """
    if off > max(FARTHEST * size, NOISE):
        raise NotFoundError(f"the body's surface lies {100.0 * off:.1f} cm from the data: {ADVICE}")


def _measured(looks: Looks) -> list[MeasuredFrame]:
    share = 1.0 / len(looks.clouds)
    return [measured(cloud.observation, share) for cloud in looks.clouds]
