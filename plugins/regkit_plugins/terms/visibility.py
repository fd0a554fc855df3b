"""Visibility: what is hidden from the camera explains no data."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from regkit.arrays import Array
from regkit.interfaces import Scene, Shares, Term
from regkit.primitives import Placed, Primitives


class Visibility(Term):
    """Weighs each primitive by how much of it the camera sees in the start pose.

    A few points of each primitive's outline are looked at; one is hidden if the ray to it passes
    through another primitive before.
    """

    kind: Literal["visibility"] = "visibility"

    least: Annotated[float, Field(gt=0.0, le=1.0)] = 0.05
    """What a wholly hidden primitive still weighs, so that it can come into sight again."""

    def against(self, scene: Scene) -> Shares:
        """The visible shares; all are one where the camera is not known."""
        if scene.observation.camera is None:
            return Shares(np.ones(len(scene.placed)))
        return Shares(np.maximum(visible_shares(scene.placed), self.least))


def visible_shares(placed: Placed[Primitives]) -> Array:
    """The share of each primitive that a camera at the origin sees, (K,), from 0 to 1.

    Primitives are taken as ellipsoids of two scales, and looked at in the middle and at four points
    of the outline that is turned to the camera.
    """
    radii = 2.0 * placed.primitives.scales
    # In units of an occluder's own radii its ellipsoid is the unit ball, and rays stay rays.
    inverse = np.swapaxes(placed.axes, 1, 2) / radii[:, :, None]
    targets = _outline(placed, radii)
    count, samples = targets.shape[:2]
    eye = -(inverse @ placed.centres[:, :, None])[:, :, 0]
    ways = targets.reshape(-1, 3) @ np.swapaxes(inverse, 1, 2)
    along = np.clip(-(ways @ eye[:, :, None])[:, :, 0] / (ways**2).sum(axis=2), 0.0, 1.0)
    nearest = eye[:, None, :] + along[:, :, None] * ways
    hidden = (nearest**2).sum(axis=2).reshape(count, count, samples) < 1.0
    hidden[np.arange(count), np.arange(count)] = False
    # An occluder has to be the nearer one of the two: its centre tells where they overlap.
    distances = np.linalg.norm(placed.centres, axis=1)
    hidden &= (distances[:, None] < distances[None, :])[:, :, None]
    return np.asarray(1.0 - hidden.any(axis=0).mean(axis=1))


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
