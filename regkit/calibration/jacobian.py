"""Derivatives of surface distances to the proportions of a body, bone by bone."""

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
    """Motion and growth of the spheres on a posed body's axes with its proportions.

    A segment's length or girth stretches everything in the segment's frame: the axes of its own
    capsules, and the joints of its child segments with all their descendants.

    Attributes:
        body: The body.
        placement: Its placement.
        groups: The G groups of its proportions.
    """

    body: Body
    placement: Placement
    groups: Groups

    def rows(self, distances: SurfaceDistances) -> Array:
        """Returns the derivative (R, 2 G) to the logarithms of the groups' lengths, then girths.

        A length's derivative to the logarithm of its factor is the length itself, so that the
        template's own lengths do not matter.
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
        """Derivative (S, 2 G, 3) of the segments' origins in the world; the root's is zero."""
        origins = np.zeros((len(self.body.skeleton.parents), 2 * len(self.groups.names), 3))
        transforms = self.placement.transforms
        for segment, parent in enumerate(self.body.skeleton.parents):
            if parent >= 0:
                offset_in_world = transforms[segment, :3, 3] - transforms[parent, :3, 3]
                offset = offset_in_world @ transforms[parent, :3, :3]
                stretched = self._stretched(np.array([parent]), offset[None])[0]
                origins[segment] = origins[parent] + stretched
        return origins

    def _stretched(self, segments: Indices, points: Array) -> Array:
        """Returns the derivative (R, 2 G, 3) in the world of points (R, 3) in segments' frames."""
        bones, groups = self.groups.bones[segments], self.groups.of_segments[segments]
        lengthwise = (points * bones).sum(axis=1, keepdims=True) * bones
        turns = self.placement.transforms[segments, :3, :3]
        rows = np.zeros((len(points), 2 * len(self.groups.names), 3))
        each = np.arange(len(points))
        rows[each, groups] = (turns @ lengthwise[:, :, None])[:, :, 0]
        across = turns @ (points - lengthwise)[:, :, None]
        rows[each, len(self.groups.names) + groups] = across[:, :, 0]
        return rows
