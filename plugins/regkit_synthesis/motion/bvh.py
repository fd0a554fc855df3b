"""Motion from BVH files."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from regkit.interchange.bvh.bvh import Bvh
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit_synthesis.figure.figure import figure_axes
from regkit_synthesis.figure.joint_map import parts_of
from regkit_synthesis.motion.motion import Rig
from regkit_synthesis.motion.sampled import SampledMotion, recorded


def read_bvh(
    path: Path, *, scale: float = 1.0, skip: int = 0, map_name: str | None = None
) -> SampledMotion:
    """Reads a BVH file, whose rest pose has all angles zero.

    The front and up directions follow from the positions of hips and head at rest.

    Args:
        path: The file.
        scale: Unit of length of the file [m]. Bodies scale motion by the length of their legs, so
            it affects the positions of the source only.
        skip: Number of frames to skip at the beginning.
        map_name: Name of a shipped joint map, or a YAML file; by default the first map that fits.

    Raises:
        ConfigError: If the map names a joint that the file lacks.
        DataError: If the file is missing or invalid, or has fewer than two frames after the
            skipped ones.
    """
    bvh = Bvh.read(path, scale=scale)
    if len(bvh.frames) < skip + 2:
        raise DataError(
            f"it has {len(bvh.frames)} frames; a motion needs two, after {skip} that are skipped",
            place=str(path),
        )
    if bvh.frame_time <= 0.0:
        raise DataError(
            f"Frame Time is {bvh.frame_time:g}; a motion needs the time between its frames",
            place=str(path),
        )
    rig, rotation = _rig(bvh, map_name, path)
    poses = [bvh.at_frame(frame) for frame in range(skip, len(bvh.frames))]
    left, right = (bvh.names.index(rig.parts[f"{side}_hip"]) for side in ("left", "right"))
    middles = np.array([(pose.positions[left] + pose.positions[right]) / 2 for pose in poses])
    turns = rotation @ np.array([pose.rotations for pose in poses]) @ rotation.T
    times = bvh.frame_time * np.arange(len(poses), dtype=np.float64)
    return recorded(rig, times, middles @ rotation.T, turns)


def _rig(bvh: Bvh, map_name: str | None, path: Path) -> tuple[Rig, Array]:
    """Returns the joints at rest, and the rotation (3, 3) from the file's axes to the ground's."""
    places = dict(zip(bvh.names, bvh.rest_positions, strict=True))
    for joint in bvh.joints:
        for end in joint.ends[:1]:
            places[f"{joint.name}.end"] = places[joint.name] + end
    parts = parts_of(list(places), map_name, path)
    try:
        rotation = figure_axes({joint: places[own] for joint, own in parts.items()})
    except DataError as error:
        raise error.at(str(path)) from None
    parents = {
        joint.name: bvh.names[joint.parent] if joint.parent >= 0 else "" for joint in bvh.joints
    }
    return Rig(parents, {name: rotation @ place for name, place in places.items()}, parts), rotation
