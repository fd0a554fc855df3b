"""The correlation kernel: the overlap of model and data Gaussians, the paper's similarity."""

from __future__ import annotations

from typing import ClassVar, Literal

from regkit.gaussians.compiled_overlap import bind, explain, respond
from regkit.gaussians.compiled_similarity import COLUMNS, shows_surface
from regkit.gaussians.overlap import Overlap
from regkit.interfaces import CompiledEnergy, Kernel
from regkit.observation import Observation
from regkit.primitives import Gaussians, Placed, Primitives


class Correlation(Kernel):
    """Spatial correlation of the model's sum of Gaussians, generalized or not, with the data's.

    The energy is minus the paper's E (eq. 5) divided by the integral of the data's Gaussians, that
    is, minus the mean density of the model over the data. It is dimensionless and does not depend
    on the number of points.
    """

    kind: Literal["correlation"] = "correlation"
    accepts: ClassVar[type[Primitives]] = Gaussians

    covariance: Literal["exact", "frozen"] = "exact"
    """Whether covariances rotate with their segments, or keep their orientation of the start pose,
    as in the paper (after eq. 11)."""

    def bind(
        self, observation: Observation, start: Placed[Gaussians], *, smoothing: float = 0.0
    ) -> Overlap:
        """Binds the kernel to the data of a frame."""
        return Overlap(observation, start, smoothing=smoothing, frozen=self.covariance == "frozen")

    def compiled(self, primitives: Primitives) -> CompiledEnergy | None:
        """Returns the kernel as compiled functions, for Gaussians."""
        surface = shows_surface(primitives)
        if surface is None:
            return None
        numbers = (surface, self.covariance == "frozen")
        state = (len(primitives), COLUMNS)
        return CompiledEnergy(respond, numbers, bind=bind, state=state, explain=explain)
