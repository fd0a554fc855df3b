"""The frames of a recording in which a body is looked at."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.calibration.cloud import Cloud
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.tracking import TrackedFrame


@dataclass(frozen=True)
class Looks:
    """A body seen in several frames.

    Attributes:
        first: Its pose in the recording's first frame.
        clouds: The data of the frames that are looked at.
        poses: The body's poses in them.
    """

    first: Pose
    clouds: tuple[Cloud, ...]
    poses: tuple[Pose, ...]


def spread(track: Iterable[TrackedFrame], length: int, count: int) -> Looks:
    """Of each of ``count`` equal parts of a track the frame with the most inliers.

    Only these are kept, for a long track of depth images is large.

    Args:
        track: The tracked frames.
        length: How many there are.
        count: How many are wanted; all of them if that is more.
    """
    count = min(count, length)
    best: dict[int, TrackedFrame] = {}
    first: list[Pose] = []
    for index, frame in enumerate(track):
        if not first:
            first.append(frame.registered.pose)
        rival = best.setdefault(index * count // length, frame)
        # A method that cannot tell says NaN, which is never more.
        if frame.registered.inlier_share > rival.registered.inlier_share:
            best[index * count // length] = frame
    return Looks(
        first[0],
        tuple(Cloud.of(frame.observation) for frame in best.values()),
        tuple(frame.registered.pose for frame in best.values()),
    )


def distances(body: Body, looks: Looks) -> Array:
    """The distances of the points of all frames to the body's surface, (N,) [m]."""
    found = []
    for cloud, pose in zip(looks.clouds, looks.poses, strict=True):
        capsules = body.capsules.place(body.place(pose).transforms)
        found.append(np.abs(capsules.surface_distance(cloud.points)))
    return np.concatenate(found)
