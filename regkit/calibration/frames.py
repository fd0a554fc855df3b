"""The frames of a recording that a calibration uses."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.calibration.cloud import Cloud
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.errors import NoDataError
from regkit.tracking import TrackedFrame


@dataclass(frozen=True)
class Looks:
    """A body seen in several frames.

    Attributes:
        first: Pose in the recording's first frame with data.
        clouds: Data of the selected frames.
        poses: Poses of the body in these frames.
    """

    first: Pose
    clouds: tuple[Cloud, ...]
    poses: tuple[Pose, ...]


@dataclass(frozen=True)
class _Look:
    """The data of a frame and their registration."""

    cloud: Cloud
    pose: Pose
    inlier_share: float


def spread(track: Iterable[TrackedFrame], length: int, count: int) -> Looks:
    """Returns the frame with the most inliers of each of ``count`` equal parts of a track.

    Only the best frame of each part is kept in memory.

    Args:
        track: The tracked frames.
        length: Number of tracked frames.
        count: Number of frames to select, at most ``length``.

    Raises:
        NoDataError: If no frame has data.
    """
    count = min(count, length)
    best: dict[int, _Look] = {}
    first: Pose | None = None
    for index, frame in enumerate(track):
        found, part = frame.registered, index * count // length
        if frame.observation is None:
            continue
        first = found.pose if first is None else first
        # A method without inlier probabilities reports NaN, which never exceeds anything.
        if part not in best or found.inlier_share > best[part].inlier_share:
            best[part] = _Look(Cloud.of(frame.observation), found.pose, found.inlier_share)
    if first is None:
        raise NoDataError("no frame of the recording has data")
    # Every camera's view of a frame is a look of its own, in the camera's frame.
    looks = [
        (Cloud.of(view.data), look.pose.moved(view.to_camera))
        for look in best.values()
        for view in look.cloud.observation.each_view
    ]
    return Looks(first, tuple(cloud for cloud, _ in looks), tuple(pose for _, pose in looks))


def distances(body: Body, looks: Looks) -> Array:
    """Returns the distances of the points of all frames to the body's surface, (N,) [m]."""
    found = []
    for cloud, pose in zip(looks.clouds, looks.poses, strict=True):
        capsules = body.capsules.place(body.place(pose).transforms)
        found.append(np.abs(capsules.surface_distance(cloud.points)))
    return np.concatenate(found)
