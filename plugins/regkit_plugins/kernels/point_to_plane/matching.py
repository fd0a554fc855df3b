"""What the kernels that match data with surfels have in common: how partners are chosen."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from regkit.interfaces import Kernel
from regkit.observation import Observation
from regkit.primitives import Primitives
from regkit.primitives.surfels import Surfels
from regkit.registration import Robust
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError


class MatchingKernel(Kernel):
    """Each data point belongs to the nearest surfel that the camera sees, as in ICP.

    The energy is the mean over the data of a robust loss of the residuals. A point without a
    partner costs as much as one at ``max_correspondence_distance``.

    Source: Besl, McKay, A method for registration of 3-D shapes, PAMI 14, 1992; the selection,
    rejection and weighting of pairs after Rusinkiewicz, Levoy, Efficient variants of the ICP
    algorithm, 3DIM 2001.
    """

    renamed: ClassVar[dict[str, str]] = {
        "reach": "max_correspondence_distance",
        "way_back": "reverse_weight",
    }
    accepts: ClassVar[type[Primitives]] = Surfels

    robust: Robust = Robust(loss="tukey")
    """What residuals cost."""
    noise: Annotated[float, Field(gt=0.0)] | None = 1.5
    """Scale of the loss in standard deviations of the data, where ``robust`` has none; null for
    that of each frame's residuals. What is estimated anew in every pose makes light of a lost limb,
    and a tracker that compares energies is misled."""
    max_correspondence_distance: Annotated[float, Field(gt=0.0)] = 10.0
    """No point has a partner that is farther away, in scales of the loss."""
    angle_deg: Annotated[float, Field(gt=0.0, le=180.0)] | None = None
    """Nor one whose normal differs by more [deg]; the preprocessor has to give the data's
    normals."""
    matches: Literal["renewed", "fixed"] = "renewed"
    """Whether partners are sought at every evaluation, or once where a solution begins.

    Renewed, one step of a Gauss-Newton solver is one round of ICP, and the distance to the nearest
    surfel is a function of the pose like any other: it falls from round to round. Fixed, a solver
    goes to the end with the same partners, as in the textbook; three rounds of it are the method's
    ``annealing: [0, 0, 0]``."""
    reverse_weight: Annotated[float, Field(ge=0.0)] = 0.0
    """Weight of the pairs in the other direction, from each visible surfel to the nearest point;
    they draw in parts of the body near which there are no data."""


def given_normals(observation: Observation, option: str) -> Array:
    """Returns the data's normals (N, 3), which an option of a kernel needs.

    Raises:
        ConfigError: If the preprocessor gives none.
    """
    if observation.normals is None:
        raise ConfigError(
            f"{option} needs the data's normals, but the preprocessor gives none; set "
            "preprocessor.normals (kind points), or leave it out",
            place=f"kernel.{option}",
        )
    return observation.normals
