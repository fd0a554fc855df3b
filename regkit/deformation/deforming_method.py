"""Base class of methods that deform a body after another method posed it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Annotated

from pydantic import Field

from regkit.body import Body
from regkit.deformation.posed_first import PosedFirst
from regkit.interfaces import Deformation, Method, ShapeModel
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError


@dataclass(frozen=True)
class Deformed:
    """What a deformation is, and how well it explains the data.

    Attributes:
        deformation: What moves the posed body onto the data.
        probability: Inlier probability of each point of the data, (N,).
        energy: The energy, in the method's own units.
        converged: Whether it converged; true if that is not known.
        iterations: Number of steps; 0 if it is not known.
        message: Reason of termination.
    """

    deformation: Deformation
    probability: Array
    energy: float
    converged: bool
    iterations: int
    message: str


class DeformingMethod(Method, ABC):
    """A method that moves the surface of a posed body onto the data.

    The pose is that of the first method; the deformation is in the result.
    """

    first: Method | None = None
    """Method that poses the body; by default regkit's own, for rigid or for articulated bodies."""
    points: Annotated[int, Field(ge=50, le=20_000)] = 2000
    """Approximate number of points of the body and of the data from which the deformation is
    fitted; it moves all points."""

    @abstractmethod
    def deformed(self, source: Array, target: Array) -> Deformed:
        """Returns the deformation of a source onto a target.

        Args:
            source: Points of the posed body, (M, 3) [m].
            target: Points of the data, (N, 3) [m].
        """

    def shape_model(self) -> ShapeModel | None:
        """Returns the shape model of the first method."""
        return None if self.first is None else self.first.shape_model()

    def bind(self, body: Body) -> PosedFirst:
        """Binds the first method to a body, and the deformation to its surface.

        Raises:
            RegkitError: If the first method does not support the body, or it has no surface.
        """
        if body.surface is None:
            raise ConfigError(
                f"method '{self.kind}' deforms a surface, and the template '{body.name}' has none; "
                "add a mesh to its YAML (mesh: FILE.npz)"
            )
        first = self._first(body).bind(body)
        return PosedFirst(first.body, first.primitives, self, first)

    def _first(self, body: Body) -> Method:
        """Returns the method that poses a body."""
        if self.first is not None:
            return self.first
        purpose = "" if len(body.skeleton.names) > 1 else "rigid"
        return Method.parse(Method.default(purpose), place=f"method {self.kind}", field="first")
