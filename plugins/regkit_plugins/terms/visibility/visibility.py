"""Visibility: reduces the weights of primitives that are occluded or out of the picture."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from regkit.body import Body
from regkit.interfaces import CompiledWeights, Scene, Term, VisibilityWeights
from regkit.observation.silhouette import Silhouette
from regkit.primitives import Placed, Primitives, Volumes
from regkit.system.arrays import Array
from regkit_plugins.terms.visibility.compiled import free_rays
from regkit_plugins.terms.visibility.compiled_term import weigh


class Visibility(Term):
    """Weights each primitive by the fraction that is visible to the camera in the start pose.

    The fraction is estimated from a few points of each primitive; a point is occluded if its ray
    intersects another primitive in front of it. Out of the picture, and where the depth image is
    unknown, nothing is visible. Kernels of surfels have their own visibility.
    """

    kind: Literal["visibility"] = "visibility"
    accepts: ClassVar[type[Primitives]] = Volumes
    weighs: ClassVar[bool] = True

    least: Annotated[float, Field(ge=1e-6, le=1.0)] = 0.05
    """Weight of an invisible primitive, with which it can become visible again."""

    def bind(self, scene: Scene) -> VisibilityWeights:
        """Returns the weights; all are one if the camera is unknown."""
        if scene.observation.camera is None:
            return VisibilityWeights(np.ones(len(scene.placed)))
        # What may be missing hides nothing.
        hiding = ~scene.body.is_optional(scene.placed.primitives.segments)
        shares = visible_shares(scene.placed, hiding, scene.observation.silhouette)
        return VisibilityWeights(np.maximum(shares, self.least))

    def compiled(self, body: Body, primitives: Primitives) -> CompiledWeights:
        """Returns the term as a compiled function."""
        hiding = ~body.is_optional(primitives.segments)
        return CompiledWeights(weigh, (self.least,), hiding[:, None].astype(float))


def visible_shares(
    placed: Placed[Primitives], hiding: NDArray[np.bool_], silhouette: Silhouette | None = None
) -> Array:
    """Returns the fraction of each primitive that a camera at the origin sees, (K,), from 0 to 1.

    Primitives are treated as 2-sigma ellipsoids, and sampled at the centre and at four points
    half-way along their two longest axes.

    Args:
        placed: The primitives in the camera's frame.
        hiding: Whether each primitive hides others, (K,).
        silhouette: What the picture shows; by default it has no end.
    """
    radii = 2.0 * placed.primitives.scales
    outline = _outline(placed, radii)
    shares = free_rays(outline, placed.centres, placed.axes, radii, hiding)
    if silhouette is None:
        return shares
    shown = silhouette.observable(outline.reshape(-1, 3)).reshape(outline.shape[:2])
    return np.asarray(shares * shown.mean(axis=1))


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
