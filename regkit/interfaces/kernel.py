"""Kernels: the similarity of placed primitives and data, and the forces on the primitives."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar

from regkit.config.plugin import Plugin
from regkit.interfaces.compiled import CompiledEnergy
from regkit.interfaces.shape import ShapeModel
from regkit.observation import Observation
from regkit.primitives import Placed, Primitives
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Response:
    """An energy to minimise and its derivatives.

    Attributes:
        energy: The energy; lower values mean a better explanation of the data.
        wrenches: Derivative to each primitive's motion, (K, 6): to its translation, then to a
            rotation vector in the world about its centre.
        stiffness: Gauss-Newton blocks of the second derivative to the same motions, (K, 6, 6); None
            if not requested or not available.
    """

    energy: float
    wrenches: Array
    stiffness: Array | None = None

    def __add__(self, other: Response) -> Response:
        """Returns the sum of two energies of the same primitives, with blocks if both have them."""
        stiffness = None
        if self.stiffness is not None and other.stiffness is not None:
            stiffness = self.stiffness + other.stiffness
        return Response(self.energy + other.energy, self.wrenches + other.wrenches, stiffness)


class Similarity(ABC):
    """A kernel bound to the data of one frame."""

    @abstractmethod
    def __call__(self, placed: Placed[Any], *, curvature: bool = False) -> Response:
        """Returns the energy of placed primitives, its wrenches and, on request, its stiffness."""

    def on_segments(
        self, placed: Placed[Any], segments: int, *, curvature: bool = False
    ) -> Response:
        """Returns the response with wrenches (S, 6) and stiffness (S, 6, 6) of the S segments.

        They are about the segments' origins. A similarity that need not know the primitives' own
        sums may be faster.
        """
        response = self(placed, curvature=curvature)
        stiffness = response.stiffness
        if stiffness is not None:
            stiffness = placed.accumulate_stiffness(stiffness, segments)
        return Response(response.energy, placed.accumulate(response.wrenches, segments), stiffness)

    def energy(self, placed: Placed[Any]) -> float:
        """Returns the energy alone, for kernels that evaluate it faster than the full response."""
        return self(placed).energy

    def inlier_probability(self, placed: Placed[Any]) -> Array | None:
        """Returns the probability (N,) that each point is an inlier; None if it is unknown."""
        return None

    def whitened(self, placed: Placed[Any]) -> tuple[Array, Array] | None:
        """Returns residuals of unit variance (N, D), and each point's share in the model (N,).

        A residual is what pulls at a point, in units of its standard deviation; their correlation
        tells how many points are independent. None if the kernel has none.
        """
        return None


class RigidSimilarity(ABC):
    """A kernel bound to the data and to primitives that move together, with pairs from one pose."""

    @abstractmethod
    def __call__(self, transform: Array) -> Response:
        """Returns the energy, one wrench (1, 6) and one block (1, 6, 6), those of the whole body.

        They are in the body's axes, about its origin.

        Args:
            transform: T_world_body, (4, 4).
        """

    @abstractmethod
    def inlier_probability(self, transform: Array) -> Array:
        """Returns the probability (N,) that each point is an inlier, for T_world_body (4, 4)."""


class RigidComparison(ABC):
    """A kernel bound to the data and to primitives that move together, without pairs yet."""

    @abstractmethod
    def paired(self, transform: Array) -> RigidSimilarity:
        """Returns the similarity with the pairs of the start pose T_world_body (4, 4)."""


class Kernel(Plugin, ABC):
    """A comparison of primitives with data, independent of the skeleton."""

    group = "regkit.kernels"
    declared = ("accepts",)

    accepts: ClassVar[type[Primitives]]
    """Type of primitives that the kernel compares."""

    def check_shape(self, shape: ShapeModel) -> None:
        """Checks that the kernel can compare the primitives of a shape model.

        Raises:
            ValueError: If it cannot; the config reports it with the place of both.
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
        """Binds the kernel to a frame.

        Args:
            observation: The data.
            start: The primitives in the start pose of the registration.
            smoothing: Standard deviation of a Gaussian that smooths the energy over space, for a
                larger basin in coarse solutions [m].
        """

    def compiled(self, primitives: Primitives) -> CompiledEnergy | None:
        """Returns the kernel as compiled functions for some primitives; None if it has none.

        They compute what ``bind`` and the bound kernel compute; a subclass that changes these
        without overriding this method has none.
        """
        return None

    def bind_rigid(
        self, observation: Observation, primitives: Any, *, smoothing: float = 0.0
    ) -> RigidComparison | None:
        """Binds the kernel to a frame and to the primitives of a body of one segment.

        Nothing of them has to be placed anew for another pose, and forces need not be known for
        each primitive, so that a kernel for many primitives may be much faster than with ``bind``.
        The energy must be the same.

        Args:
            observation: The data.
            primitives: The primitives in the body's frame.
            smoothing: As for ``bind`` [m].

        Returns:
            The comparison; None if the kernel has none for rigid bodies.
        """
        return None
