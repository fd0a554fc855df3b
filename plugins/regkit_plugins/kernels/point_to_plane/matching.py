"""The base class of kernels that match data with surfels."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from regkit.config.quantities import Factor
from regkit.interfaces import Kernel
from regkit.observation import Observation
from regkit.primitives import Primitives
from regkit.primitives.surfels import Surfels
from regkit.registration import Robust
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError


class MatchingKernel(Kernel):
    """Matches each data point with the nearest visible surfel, as in ICP.

    The energy is the mean over the data of a robust loss of the residuals. A point without a
    correspondence costs as much as one at ``max_correspondence_distance``.

    Source: Besl, McKay, A method for registration of 3-D shapes, PAMI 14, 1992; the selection,
    rejection and weighting of pairs follow Rusinkiewicz, Levoy, Efficient variants of the ICP
    algorithm, 3DIM 2001.
    """

    renamed: ClassVar[dict[str, str]] = {
        "reach": "max_correspondence_distance",
        "way_back": "reverse_weight",
    }
    accepts: ClassVar[type[Primitives]] = Surfels

    robust: Robust = Robust(loss="tukey")
    """Robust loss of the residuals."""
    noise: Factor | None = 1.5
    """Scale of the loss in standard deviations of the data, if ``robust`` has none; null estimates
    it from each frame's residuals. An estimate in every pose would hide a lost limb from a tracker
    that compares energies."""
    max_correspondence_distance: Factor = 10.0
    """Maximum distance of a pair, in scales of the loss."""
    angle_deg: Annotated[float, Field(ge=0.01, le=180.0)] | None = None
    """Maximum angle between the normals of a pair [deg]; it needs normals from the preprocessor."""
    matches: Literal["renewed", "fixed"] = "renewed"
    """Whether correspondences are updated at every evaluation, or fixed at the start of a solution.

    If renewed, each step of a Gauss-Newton solver is an iteration of ICP, and the energy, a
    function of the pose like any other, decreases with each step. If fixed, a solver converges with
    the same correspondences, as in textbook ICP; the method's ``annealing: [0, 0, 0]`` makes three
    iterations of it."""
    reverse_weight: Annotated[float, Field(ge=0.0, le=1e6)] = 0.0
    """Weight of pairs in the other direction, from each visible surfel to the nearest point; they
    attract parts of the body without data nearby."""


def given_normals(observation: Observation, option: str) -> Array:
    """Returns the data's normals (N, 3), which an option of a kernel needs.

    Raises:
        ConfigError: If the preprocessor provides none.
    """
    if observation.normals is None:
        raise ConfigError(
            f"{option} needs the data's normals, but the preprocessor gives none; set "
            "preprocessor.normals (kind points), or leave it out",
            place=f"kernel.{option}",
        )
    return observation.normals
