"""The body first, then its parts: a part is registered only where there are data of it."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from regkit.body import Body
from regkit.body.lifting import Lifting
from regkit.config.plugin import slot_default
from regkit.config.quantities import Length
from regkit.interfaces import Method, Registrar, ShapeModel
from regkit_plugins.methods.body_first.bound import BoundBodyFirst


class BodyFirst(Method):
    """Registers the base of a composed body, then the whole where its parts are seen.

    It wants fine data, such as voxels of 8 mm for hands. The base is registered to coarser ones, as
    a body without parts is. From there and from the last pose, the whole is registered to data that
    are fine near the parts. Where no part has enough data, because the body is far or hides its
    hands, the parts keep their joints, and cost hardly anything. A body without parts is registered
    by the method alone.
    """

    kind: Literal["body_first"] = "body_first"

    method: Method = slot_default(Method)
    """Method that registers the base, and the whole."""
    least_points: Annotated[int, Field(ge=1, le=1_000_000)] = 20
    """Least number of points of the data that belong to a part for which it is registered."""
    reach: Annotated[float, Field(ge=0.0, le=10.0)] = 0.35
    """Distance from a part within which the data are fine, as a fraction of the part's size."""
    coarse: Length = 0.03
    """Voxel size of the data elsewhere [m]."""

    def shape_model(self) -> ShapeModel | None:
        """Returns the shape model of the method."""
        return self.method.shape_model()

    def bind(self, body: Body) -> Registrar:
        """Binds the method to a composed body and to its base, or to a body without parts.

        Raises:
            RegkitError: If the method cannot register such bodies.
        """
        whole, lifting = self.method.bind(body), Lifting.of(body)
        if lifting is None:
            return whole
        base = self.method.bind(lifting.base)
        return BoundBodyFirst(self, body, whole.primitives, lifting, base, whole)
