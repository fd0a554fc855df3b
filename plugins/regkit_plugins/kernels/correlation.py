"""The paper's similarity: the overlap of the template's Gaussians with those of the data."""

from __future__ import annotations

from typing import ClassVar, Literal

from regkit.gaussians.overlap import Overlap
from regkit.interfaces import Kernel
from regkit.observation import Observation
from regkit.primitives import Gaussians, Placed, Primitives


class Correlation(Kernel):
    """Spatial correlation of a sum of Gaussians, generalized or not, with that of the data.

    The energy is minus the paper's E (eq. 5) divided by the integral of the data's Gaussians, that
    is, minus the mean density of the template over the data: a number without a unit, whose size
    does not depend on how many points there are.
    """

    kind: Literal["correlation"] = "correlation"
    accepts: ClassVar[type[Primitives]] = Gaussians

    covariance: Literal["exact", "frozen"] = "exact"
    """Whether covariances turn with their segments, or keep their orientation of the start pose, as
    the paper has it (after eq. 11)."""

    def bind(
        self, observation: Observation, start: Placed[Gaussians], *, smoothing: float = 0.0
    ) -> Overlap:
        """Bind the kernel to a frame's data."""
        return Overlap(observation, start, smoothing=smoothing, frozen=self.covariance == "frozen")
