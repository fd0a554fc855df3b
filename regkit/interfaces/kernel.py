"""Kernels: how well placed primitives explain data, and the forces that the data put on them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar

from regkit.config.plugin import Plugin
from regkit.interfaces.shape import ShapeModel
from regkit.observation import Observation
from regkit.primitives import Placed, Primitives
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Response:
    """An energy, which registration makes small, and its derivative.

    Attributes:
        energy: The energy; the lower, the better the primitives explain the data.
        wrenches: Its derivative to each primitive's motion, (K, 6): to the translation of the
            primitive, then to a rotation vector in the world about the primitive's own centre.
        stiffness: Gauss-Newton blocks of its second derivative to the same motions, (K, 6, 6), if
            they were asked for and the kernel has them.
    """

    energy: float
    wrenches: Array
    stiffness: Array | None = None

    def __add__(self, other: Response) -> Response:
        """The sum of two energies of the same primitives; it has blocks if both have."""
        stiffness = None
        if self.stiffness is not None and other.stiffness is not None:
            stiffness = self.stiffness + other.stiffness
        return Response(self.energy + other.energy, self.wrenches + other.wrenches, stiffness)


class Similarity(ABC):
    """A kernel bound to the data of one frame."""

    @abstractmethod
    def __call__(self, placed: Placed[Any], *, curvature: bool = False) -> Response:
        """The energy of primitives in the world, its derivative, and the stiffness if asked for."""

    def energy(self, placed: Placed[Any]) -> float:
        """Returns the energy alone, where that takes less than all of the response."""
        return self(placed).energy

    def inlier_probability(self, placed: Placed[Any]) -> Array | None:
        """The probability (N,) that each point is an inlier; None if the kernel cannot tell."""
        return None


class Kernel(Plugin, ABC):
    """Compares primitives with data; it never sees a skeleton."""

    group = "regkit.kernels"
    declared = ("accepts",)

    accepts: ClassVar[type[Primitives]]
    """The primitives that it can compare."""

    def check_shape(self, shape: ShapeModel) -> None:
        """Refuse a shape model whose primitives it cannot compare.

        Raises:
            ValueError: If it makes others, to be told where the two stand together.
        """
        if not issubclass(shape.makes, self.accepts):
            raise ValueError(
                f"kernel '{self.kind}' compares {self.accepts.__name__}, but shape '{shape.kind}' "
                f"makes {shape.makes.__name__}"
            )

    @abstractmethod
    def bind(
        self, observation: Observation, start: Placed[Any], *, smoothing: float = 0.0
    ) -> Similarity:
        """Bind the kernel to a frame.

        Args:
            observation: The data.
            start: The primitives in the pose from which the frame is registered.
            smoothing: Standard deviation [m] of a Gaussian that smooths the energy over space, by
                which a first, coarse solution sees farther.
        """
