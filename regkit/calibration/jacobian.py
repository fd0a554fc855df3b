"""How surface distances change with the proportions of a body, bone by bone."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from regkit.body import Body
from regkit.body.distance import SurfaceDistances
from regkit.body.groups import Groups
from regkit.skeleton import Placement
from regkit.system.arrays import Array, Indices


@dataclass(frozen=True)
class ProportionJacobian:
    """How the spheres on a posed body's axes move and grow.

    A length or girth of a segment stretches all that is in the segment's frame: the axes of its own
    capsules, and the joints of the segments that hang on it, with all that hangs on these.

    Attributes:
        body: The body.
        placement: Its pose.
        groups: The groups of its proportions, G of them.
    """

    body: Body
    placement: Placement
    groups: Groups

    def rows(self, distances: SurfaceDistances) -> Array:
        """The derivative (R, 2 G) to the logarithms of the groups' lengths, then of their girths.

        At the logarithm of a factor a length changes by itself, so that the template's own lengths
        do not matter.
        """
        along, segments, own = distances.along, distances.segments, distances.capsules
        ends, radii = self.body.capsules.ends[own], self.body.capsules.radii[own]
        local = ends[:, 0] + along[:, None] * (ends[:, 1] - ends[:, 0])
        thick = radii[:, 0] + along * (radii[:, 1] - radii[:, 0])
        moved = self._origins[segments] + self._stretched(segments, local)
        rows = -(moved @ distances.directions[:, :, None])[:, :, 0]
        girths = len(self.groups.names) + self.groups.of_segments[segments]
        rows[np.arange(len(rows)), girths] -= thick * distances.directions.any(axis=1)
        return np.asarray(rows)

    @cached_property
    def _origins(self) -> Array:
        """The derivative (S, 2 G, 3) of the segments' origins in the world; the root's rests."""
        origins = np.zeros((len(self.body.skeleton.parents), 2 * len(self.groups.names), 3))
        transforms = self.placement.transforms
        for segment, parent in enumerate(self.body.skeleton.parents):
            if parent >= 0:
                way = transforms[segment, :3, 3] - transforms[parent, :3, 3]
                offset = way @ transforms[parent, :3, :3]
                stretched = self._stretched(np.array([parent]), offset[None])[0]
                origins[segment] = origins[parent] + stretched
        return origins

    def _stretched(self, segments: Indices, points: Array) -> Array:
        """The derivative (R, 2 G, 3) in the world of points (R, 3) that are in segments' frames."""
        bones, groups = self.groups.bones[segments], self.groups.of_segments[segments]
        lengthwise = (points * bones).sum(axis=1, keepdims=True) * bones
        turns = self.placement.transforms[segments, :3, :3]
        rows = np.zeros((len(points), 2 * len(self.groups.names), 3))
        each = np.arange(len(points))
        rows[each, groups] = (turns @ lengthwise[:, :, None])[:, :, 0]
        across = turns @ (points - lengthwise)[:, :, None]
        rows[each, len(self.groups.names) + groups] = across[:, :, 0]
        return rows
