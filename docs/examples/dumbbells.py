"""A shape model in one file: `regkit run EXPERIMENT --plugin docs/examples/dumbbells.py`."""

from typing import ClassVar, Literal

import numpy as np

from regkit.body import Body
from regkit.config.plugin import register
from regkit.interfaces import ShapeModel
from regkit.primitives import Gaussians, Primitives


@register
class Dumbbells(ShapeModel):
    """Two isotropic Gaussians per capsule, one at each end."""

    kind: Literal["dumbbells"] = "dumbbells"
    makes: ClassVar[type[Primitives]] = Gaussians

    share: float = 0.5
    """Standard deviation as a fraction of the capsule's radius."""

    def bind(self, body: Body) -> Gaussians:
        """Returns Gaussians at the ends of the body's capsules."""
        capsules = body.capsules
        radii = capsules.radii.reshape(-1)
        return Gaussians(
            segments=np.repeat(capsules.segments, 2),
            centres=capsules.ends.reshape(-1, 3),
            axes=np.tile(np.eye(3), (len(radii), 1, 1)),
            scales=np.repeat(self.share * radii[:, None], 3, axis=1),
            weights=np.ones(len(radii)),
        )
