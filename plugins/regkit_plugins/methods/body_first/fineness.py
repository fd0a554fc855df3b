"""How fine the data are: as they are near the parts of a body, and coarser elsewhere."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from regkit.body import Body
from regkit.clouds import voxel_downsampled
from regkit.observation import Observation
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.brief import Brief


@dataclass(frozen=True)
class Nearness(Brief):
    """Which data are near the parts that are attached to a body.

    Attributes:
        points: Whether each point is near one of them, (N,).
        most: Largest number of points that belong to one of them.
    """

    points: NDArray[np.bool_]
    most: int

    @classmethod
    def of(cls, body: Body, pose: Pose, points: Array, reach: float) -> Nearness:
        """Returns the points near the attached parts.

        A point belongs to a part that it is near to, if no other part of the body is nearer.

        Args:
            body: The body.
            pose: Its pose.
            points: The points, (N, 3) [m].
            reach: Distance from a part, as a fraction of its size, at which a point is near.
        """
        capsules = body.capsules.place(body.place(pose).transforms)
        near, most = np.zeros(len(points), dtype=np.bool_), 0
        columns = np.ascontiguousarray(points.T)
        for part in body.attached_parts:
            own = np.isin(capsules.segments, part.segments)
            if not own.any():
                continue
            surface, distance = capsules.selected(own), reach * part.size
            room = float(surface.radii.max()) + distance
            low, high = surface.ends.min(axis=(0, 1)) - room, surface.ends.max(axis=(0, 1)) + room
            beside = np.ones(len(points), dtype=np.bool_)
            for column, least, greatest in zip(columns, low, high, strict=True):
                beside &= (column >= least) & (column <= greatest)
            inside = np.flatnonzero(beside)
            gaps = surface.surface_distance(points[inside])
            within = inside[gaps <= distance]
            near[within] = True
            others = capsules.selected(~own).surface_distance(points[within])
            most = max(most, int((gaps[gaps <= distance] < others).sum()))
        return cls(near, most)


def thinned_elsewhere(
    observation: Observation, fine: NDArray[np.bool_] | None, voxel: float
) -> Observation:
    """Returns data that are as they are where ``fine`` is true, and in voxels elsewhere.

    Args:
        observation: The data; all points have the same variance.
        fine: Which points stay, (N,); None if none do.
        voxel: Voxel size [m].
    """
    keep = np.zeros(len(observation.points), dtype=np.bool_) if fine is None else fine
    if observation.views:
        ends = np.cumsum([len(view.data.points) for view in observation.views])
        each = np.split(keep, ends[:-1])
        views = [
            replace(view, data=thinned_elsewhere(view.data, own, voxel))
            for view, own in zip(observation.views, each, strict=True)
        ]
        return Observation.of_views(views, observation.landmarks)
    points = observation.points[keep]
    if not keep.all():
        points = np.concatenate([voxel_downsampled(observation.points[~keep], voxel), points])
    return replace(
        observation,
        points=points,
        weights=np.ones(len(points)),
        variances=np.full(len(points), observation.variances[0]),
        normals=None,
    )
