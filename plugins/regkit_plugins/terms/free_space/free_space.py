"""Free space: keeps the body out of the space that the camera sees as empty."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from regkit.body import Body
from regkit.config.quantities import Margin, Weight
from regkit.geometry.rotation import cross
from regkit.interfaces import CompiledEnergy, Scene, Term
from regkit.primitives import Placed, Primitives
from regkit.registration import Residuals, ResidualSimilarity
from regkit.registration.robust import PseudoHuber
from regkit.system.arrays import Array
from regkit_plugins.terms.free_space.compiled import (
    MARGIN,
    OFFSET,
    OWNER,
    WEIGHT,
    WIDTH,
    respond,
)

REACH = 1.0
"""Position of a primitive's samples along its longest axis, in units of its scale."""


class FreeSpace(Term):
    """Penalises primitives outside the silhouette, or in front of the measured depth.

    The axes of the primitives should be behind the measured surface. Invalid pixels count as free
    space, like those of a background out of range. Without a depth image the term has no effect.
    """

    kind: Literal["free_space"] = "free_space"

    weight: Weight = 1.0
    """Weight relative to the kernel's energy."""
    margin: Margin = 0.5
    """Allowed distance of an axis in front of the measured depth, in units of the primitive's
    smallest scale."""

    def bind(self, scene: Scene) -> BoundFreeSpace:
        """Binds the term to the depth image of a frame."""
        return BoundFreeSpace(self, scene)

    def compiled(self, body: Body, primitives: Primitives) -> CompiledEnergy:
        """Returns the term as a compiled function."""
        return CompiledEnergy(respond, table=self.samples(body, primitives))

    def samples(self, body: Body, primitives: Primitives) -> Array:
        """Returns the samples of K primitives: owner, offset in its axes, width, margin, weight.

        There are three for each primitive, (3 K, 7); a single one is enough for balls, (K, 7).
        """
        scales = primitives.scales
        ordered = np.sort(scales, axis=1)
        sizes = ordered[:, 1:].prod(axis=1)
        each = 1 if (ordered[:, 0] == ordered[:, 2]).all() else 3
        sizes[body.is_optional(primitives.segments)] = 0.0
        samples = np.zeros((len(scales), each, 7))
        samples[:, :, OWNER] = np.arange(len(scales))[:, None]
        samples[:, :, WIDTH] = ordered[:, :1]
        samples[:, :, MARGIN] = self.margin * ordered[:, :1]
        samples[:, :, WEIGHT] = (self.weight * sizes / sizes.sum() / each)[:, None]
        longest = OFFSET + scales.argmax(axis=1)
        for column, sign in ((1, 1.0), (2, -1.0))[: each - 1]:
            outwards = sign * REACH * (ordered[:, 2] - ordered[:, 0])
            samples[np.arange(len(scales)), column, longest] = outwards
        return samples.reshape(-1, 7)


class BoundFreeSpace(ResidualSimilarity):
    """``sum w (sqrt(1 + (d / s)^2) - 1)`` over samples of the primitives.

    d is the distance of a sample inside free space, and s the primitive's smallest scale.

    Args:
        term: The term.
        scene: The frame.
    """

    def __init__(self, term: FreeSpace, scene: Scene) -> None:
        super().__init__(scene.observation, PseudoHuber(1.0))
        samples = term.samples(scene.body, scene.placed.primitives)
        count = len(scene.placed)
        self._each = len(samples) // count
        self._owners = samples[:, OWNER].astype(np.intp)
        self._weights, self._widths = samples[:, WEIGHT], samples[:, WIDTH]
        self._margins = samples[:, MARGIN]
        offsets = samples[:, OFFSET : OFFSET + 3].reshape(count, self._each, 3)
        self._offsets = offsets.transpose(0, 2, 1)
        self._silhouette = scene.observation.silhouette

    def residuals(self, placed: Placed[Any]) -> Residuals:
        """Returns the distance of each sample inside free space, in units of the smallest scale."""
        if self._silhouette is None:
            return _NONE
        arms = (placed.axes @ self._offsets).transpose(0, 2, 1)
        points = (placed.centres[:, None, :] + arms).reshape(-1, 3)
        distances, gradients = self._silhouette.distances(points, self._margins)
        # The others have no energy and no derivative.
        inside = np.flatnonzero(distances)
        if not len(inside):
            return _NONE
        gradients, scales = gradients[inside], self._widths[inside]
        rows = np.concatenate([gradients, cross(arms.reshape(-1, 3)[inside], gradients)], axis=1)
        return Residuals(
            self._owners[inside],
            distances[inside] / scales,
            rows / scales[:, None],
            self._weights[inside],
        )


_NONE = Residuals(np.zeros(0, dtype=np.intp), np.zeros(0), np.zeros((0, 6)), np.zeros(0))
"""The residuals if no sample is in free space."""
