"""How gaps change with the pose and the proportions of a body: the chain rule, bone by bone."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from regkit.body import Body
from regkit.body.groups import Groups
from regkit.calibration.gaps import Gaps
from regkit.geometry.rotation import cross
from regkit.skeleton import Placement
from regkit.system.arrays import Array, Indices


@dataclass(frozen=True)
class Slopes:
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

    def to_pose(self, gaps: Gaps) -> Array:
        """The derivative (R, n) of gaps to the degrees of freedom."""
        segments = self.body.capsules.segments[gaps.capsules]
        arms = gaps.centres - self.placement.transforms[segments, :3, 3]
        wrenches = -np.concatenate([gaps.directions, cross(arms, gaps.directions)], axis=1)
        return np.asarray((wrenches[:, None, :] @ self.placement.jacobian[segments])[:, 0])

    def to_proportions(self, gaps: Gaps) -> Array:
        """The derivative (R, 2 G) to the logarithms of the groups' lengths, then of their girths.

        At the logarithm of a factor a length changes by itself, so that the template's own lengths
        do not matter.
        """
        capsules, along = self.body.capsules, gaps.along
        segments = capsules.segments[gaps.capsules]
        ends, radii = capsules.ends[gaps.capsules], capsules.radii[gaps.capsules]
        local = ends[:, 0] + along[:, None] * (ends[:, 1] - ends[:, 0])
        thick = radii[:, 0] + along * (radii[:, 1] - radii[:, 0])
        moved = self._origins[segments] + self._stretched(segments, local)
        slopes = -(moved @ gaps.directions[:, :, None])[:, :, 0]
        girths = len(self.groups.names) + self.groups.of_segments[segments]
        slopes[np.arange(len(slopes)), girths] -= thick * gaps.directions.any(axis=1)
        return np.asarray(slopes)

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
        slopes = np.zeros((len(points), 2 * len(self.groups.names), 3))
        each = np.arange(len(points))
        slopes[each, groups] = (turns @ lengthwise[:, :, None])[:, :, 0]
        across = turns @ (points - lengthwise)[:, :, None]
        slopes[each, len(self.groups.names) + groups] = across[:, :, 0]
        return slopes
