"""Export of tracked motion as BVH."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from regkit.body import Body
from regkit.interchange.bvh.bvh import Bvh
from regkit.interchange.bvh.euler import continuous_zyx
from regkit.interchange.bvh.hierarchy import CHANNELS, BvhJoint
from regkit.interchange.motion import UPRIGHT_CAMERA, TrackedMotion
from regkit.system.arrays import Array, read_only

_TURNS = tuple(reversed(CHANNELS[3:]))
"""The rotation channels: about z, then y, then x."""


def bvh_of(motion: TrackedMotion) -> Bvh:
    """Returns a BVH motion with a joint for each segment, and an end site for each leaf.

    The world has y up, and the camera looks along -z. At rest the axes of all joints are parallel
    to the body's, as the format requires, whatever the axes of the segments.
    """
    skeleton = motion.body.skeleton
    slides = [
        skeleton.is_free(name) or (name in skeleton.joint_dofs and skeleton.is_prismatic(name))
        for name in skeleton.names
    ]
    rest = motion.body.place(skeleton.rest()).transforms
    parents = [int(parent) for parent in skeleton.parents]
    # Removing the rest rotation of each segment leaves the rotation of the body's axes.
    rotations = UPRIGHT_CAMERA @ motion.transforms[..., :3, :3] @ rest[:, :3, :3].swapaxes(1, 2)
    places = motion.transforms[..., :3, 3] @ UPRIGHT_CAMERA.T
    joints, columns = [], []
    for index, name in enumerate(_words(skeleton.names)):
        parent = parents[index]
        place = rest[index, :3, 3]
        leaf = index not in parents
        joints.append(
            BvhJoint(
                name=name,
                parent=parent,
                offset=read_only(place - rest[parent, :3, 3] if parent >= 0 else np.zeros(3)),
                channels=(*CHANNELS[:3], *_TURNS) if parent < 0 or slides[index] else _TURNS,
                ends=(read_only(rest[index, :3, :3] @ _end(motion.body, index)),) if leaf else (),
            )
        )
        if parent < 0:
            columns.append(places[:, index])
        elif slides[index]:
            arms = places[:, index] - places[:, parent]
            columns.append((arms[:, None, :] @ rotations[:, parent])[:, 0])
        own = rotations[:, index]
        relative = own if parent < 0 else rotations[:, parent].swapaxes(1, 2) @ own
        columns.append(np.degrees(continuous_zyx(relative)))
    return Bvh(tuple(joints), 1.0 / motion.fps, read_only(np.concatenate(columns, axis=1)))


def _words(names: Sequence[str]) -> list[str]:
    """Returns unique names without control characters, whitespace and braces, which end a name."""
    words: list[str] = []
    for name in names:
        word = re.sub(r"[\s{}\x00-\x1f\x7f-\x9f]", "_", name) or "_"
        while word in words or (word != name and word in names):
            word += "_"
        words.append(word)
    return words


def _end(body: Body, segment: int) -> Array:
    """Returns the farthest marker of a segment, or else the farthest capsule end, (3,) [m]."""
    markers = body.markers.points[body.markers.segments == segment]
    ends = body.capsules.ends[body.capsules.segments == segment].reshape(-1, 3)
    for points in (markers, ends):
        distances = np.linalg.norm(points, axis=1)
        if distances.max(initial=0.0) > 0.0:
            return np.asarray(points[distances.argmax()])
    return np.zeros(3)
