"""Visibility: reduces the weights of occluded primitives."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from regkit.interfaces import Scene, Term, VisibilityWeights
from regkit.primitives import Placed, Primitives, Volumes
from regkit.system.arrays import Array
from regkit_plugins.terms.visibility.compiled import free_rays


class Visibility(Term):
    """Weights each primitive by the fraction that is visible to the camera in the start pose.

    The fraction is estimated from a few points of each primitive; a point is occluded if its ray
    intersects another primitive in front of it. Kernels of surfels have their own visibility.
    """

    kind: Literal["visibility"] = "visibility"
    accepts: ClassVar[type[Primitives]] = Volumes
    weighs: ClassVar[bool] = True

    least: Annotated[float, Field(ge=1e-6, le=1.0)] = 0.05
    """Weight of a fully occluded primitive, with which it can become visible again."""

    def bind(self, scene: Scene) -> VisibilityWeights:
        """Returns the weights; all are one if the camera is unknown."""
        if scene.observation.camera is None:
            return VisibilityWeights(np.ones(len(scene.placed)))
        # What may be missing hides nothing.
        hiding = ~scene.body.is_optional(scene.placed.primitives.segments)
        return VisibilityWeights(np.maximum(visible_shares(scene.placed, hiding), self.least))


def visible_shares(placed: Placed[Primitives], hiding: NDArray[np.bool_]) -> Array:
    """Returns the fraction of each primitive that a camera at the origin sees, (K,), from 0 to 1.

    Primitives are treated as 2-sigma ellipsoids, and sampled at the centre and at four points
    half-way along their two longest axes.

    Args:
        placed: The primitives in the camera's frame.
        hiding: Whether each primitive hides others, (K,).
    """
    radii = 2.0 * placed.primitives.scales
    return free_rays(_outline(placed, radii), placed.centres, placed.axes, radii, hiding)


def _outline(placed: Placed[Primitives], radii: Array) -> Array:
    """Returns the sample points of each primitive, (K, 5, 3) [m]."""
    longest = np.argsort(radii, axis=1)[:, 1:]
    each = np.arange(len(radii))
    offsets = [
        0.5 * radii[each, longest[:, k], None] * placed.axes[each, :, longest[:, k]]
        for k in range(2)
    ]
    moves = np.stack([0.0 * offsets[0], *offsets, *(-offset for offset in offsets)], axis=1)
    return np.asarray(placed.centres[:, None, :] + moves)
