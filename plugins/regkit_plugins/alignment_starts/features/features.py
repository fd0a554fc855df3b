"""Matched features of two surfaces, at one resolution after the other until the answer is sure."""

from __future__ import annotations

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from regkit.clouds import spacing, voxel_for
from regkit.interfaces import Method
from regkit.interfaces.alignment_start import AlignmentCandidate, AlignmentStart
from regkit.system.arrays import Array
from regkit_plugins.alignment_starts.features.prepared import Prepared, Surface
from regkit_plugins.alignment_starts.features.search import Found, searched

Points = Annotated[int, Field(ge=100, le=20_000)]


class Features(AlignmentStart):
    """Matched surface features, verified by the overlap of both surfaces and by free space.

    Points of few voxels are described by fast point feature histograms. Matches vote for motions by
    their consistency in pairs, and the motions are judged by how much of both surfaces lies on the
    other with the same normal. A cloud that is one view, from whose camera no point hides another,
    also tells where space is free: what a motion puts there contradicts it.
    """

    kind: Literal["features"] = "features"

    points: Annotated[tuple[Points, ...], Field(min_length=1, max_length=5)] = (1000, 1500)
    """Approximate numbers of points at each resolution, in ascending order."""
    radius: Annotated[float, Field(ge=2.0, le=50.0)] = 5.0
    """Radius of a descriptor, in voxels."""
    sure: Annotated[float, Field(ge=0.0, le=1.0)] = 0.3
    """Overlap, less what contradicts it, at which no finer resolution is tried."""
    most: Annotated[int, Field(ge=1, le=100)] = 5
    """Greatest number of candidates."""

    def candidates(self, source: Array, target: Array, method: Method) -> list[AlignmentCandidate]:
        """Returns the motions with the greatest overlap, less what contradicts them.

        The identity and aligned centroids compete, too.
        """
        surfaces = Surface.of(source), Surface.of(target)
        here, there = (surface.origin for surface in surfaces)
        guesses = np.zeros((2, 3, 4))
        guesses[:, :, :3] = np.eye(3)
        guesses[0, :, 3] = here - there
        found: list[Found] = []
        voxel = 0.0
        for count in self.points:
            finer = max(voxel_for(cloud, count) or spacing(cloud) for cloud in (source, target))
            if finer == voxel:
                break
            voxel = finer
            prepared = [Prepared.of(each, voxel, self.radius * voxel) for each in surfaces]
            before = np.array([one.motion for one in found]).reshape(-1, 3, 4)
            competing = np.concatenate([guesses, before])
            found = searched(prepared[0], prepared[1], voxel, competing, self.most)
            if found[0].score >= self.sure:
                break
        return [self._candidate(one, here, there, voxel) for one in found]

    def _candidate(
        self, found: Found, here: Array, there: Array, voxel: float
    ) -> AlignmentCandidate:
        """Returns a motion in the coordinates of the clouds."""
        transform = np.eye(4)
        transform[:3] = found.motion
        transform[:3, 3] += there - found.motion[:, :3] @ here
        return AlignmentCandidate(
            transform,
            voxel,
            f"matched features in voxels of {voxel:.3g}, {100.0 * found.overlap:.0f} % overlap"
            + (f" and {100.0 * found.against:.0f} % against it" if found.against >= 0.005 else ""),
            found.score,
        )
