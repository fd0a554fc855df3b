"""A shape model in one file: two Gaussians per capsule.

regkit run EXPERIMENT.yaml --plugin dumbbells.py
"""

from typing import ClassVar, Literal

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
        """Gaussians at the ends of the body's capsules."""
        ends = self.capsules_of(body).axis_samples(2)
        return Gaussians.isotropic(ends.segments, ends.points, self.share * ends.radii)
