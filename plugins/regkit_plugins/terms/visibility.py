"""Visibility: what is hidden from the camera explains no data."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from regkit.interfaces import Scene, Term, VisibilityWeights
from regkit.primitives import Placed, Primitives, Volumes
from regkit.system.arrays import Array
from regkit_plugins.terms.compiled import free_rays


class Visibility(Term):
    """Weighs each primitive by how much of it the camera sees in the start pose.

    A few points of each primitive's outline are looked at; one is hidden if the ray to it passes
    through another primitive before. The kernels of surfels have a way of their own.
    """

    kind: Literal["visibility"] = "visibility"
    accepts: ClassVar[type[Primitives]] = Volumes

    least: Annotated[float, Field(gt=0.0, le=1.0)] = 0.05
    """What a wholly hidden primitive still weighs, so that it can come into sight again."""

    def bind(self, scene: Scene) -> VisibilityWeights:
        """The visible shares; all are one where the camera is not known."""
        if scene.observation.camera is None:
            return VisibilityWeights(np.ones(len(scene.placed)))
        return VisibilityWeights(np.maximum(visible_shares(scene.placed), self.least))


def visible_shares(placed: Placed[Primitives]) -> Array:
    """The share of each primitive that a camera at the origin sees, (K,), from 0 to 1.

    Primitives are taken as ellipsoids of two scales, and looked at in the middle and at four points
    of the outline that is turned to the camera.
    """
    radii = 2.0 * placed.primitives.scales
    return free_rays(_outline(placed, radii), placed.centres, placed.axes, radii)


def _outline(placed: Placed[Primitives], radii: Array) -> Array:
    """The middle and four points half-way to the outline of each primitive, (K, 5, 3) [m]."""
    longest = np.argsort(radii, axis=1)[:, 1:]
    each = np.arange(len(radii))
    offsets = [
        0.5 * radii[each, longest[:, k], None] * placed.axes[each, :, longest[:, k]]
        for k in range(2)
    ]
    moves = np.stack([0.0 * offsets[0], *offsets, *(-offset for offset in offsets)], axis=1)
    return np.asarray(placed.centres[:, None, :] + moves)
