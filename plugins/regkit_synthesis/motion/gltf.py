"""Motion from animations in glTF files."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from regkit.config.model import did_you_mean
from regkit.interchange.bone_frames import nearest_rotations
from regkit.interchange.gltf.clip import GltfClip
from regkit.interchange.gltf.gltf import RiggedBody
from regkit.system.errors import ConfigError, DataError
from regkit.system.guard import reading
from regkit_synthesis.figure.figure import figure_axes
from regkit_synthesis.figure.joint_map import parts_of
from regkit_synthesis.motion.motion import Rig
from regkit_synthesis.motion.sampled import SampledMotion, recorded

_STEP = 1.0 / 60.0
"""Maximum time between samples of an animation, which is sampled at its keyframes [s]."""


def read_gltf(
    path: Path, *, animation: str | None = None, map_name: str | None = None
) -> SampledMotion:
    """Reads an animation of a rigged body, whose rest pose is the bind pose of its mesh.

    The front and up directions follow from the positions of hips and head at rest.

    Args:
        path: A ``.glb`` or ``.gltf`` file.
        animation: Name of the animation; required if the file has several.
        map_name: Name of a shipped joint map, or a YAML file; by default the first map that fits.

    Raises:
        ConfigError: If there is no such animation, or the map names a joint that the file lacks.
        DataError: If the file is missing or invalid, or has no animation.
    """
    body = RiggedBody.read(path)
    with reading(path, "a glTF animation of a rigged body"):
        return _sampled(body, animation, map_name, path)


def _sampled(
    body: RiggedBody, animation: str | None, map_name: str | None, path: Path
) -> SampledMotion:
    clip = _clip(body.clips, animation)
    mesh = body.mesh
    places = dict(zip(mesh.labels, mesh.rest[:, :3, 3], strict=True))
    parts = parts_of(mesh.labels, map_name, path)
    rotation = figure_axes({joint: places[own] for joint, own in parts.items()})
    begin, end = clip.times[0], clip.times[-1]
    count = max(2, int(np.ceil((end - begin) / _STEP)) + 1)
    times = np.unique(np.concatenate([clip.times, np.linspace(begin, end, count)]))
    poses = np.array([clip.at(time) for time in times])
    hips = [mesh.bone(parts[f"{side}_hip"]) for side in ("left", "right")]
    moves = (poses @ np.linalg.inv(mesh.rest))[..., :3, :3]
    turns = nearest_rotations(moves.reshape(-1, 3, 3)).reshape(moves.shape)
    parents = {
        label: mesh.labels[parent] if parent >= 0 else ""
        for label, parent in zip(mesh.labels, mesh.parents, strict=True)
    }
    return recorded(
        Rig(parents, {name: rotation @ place for name, place in places.items()}, parts),
        times - begin,
        poses[:, hips][..., :3, 3].mean(axis=1) @ rotation.T,
        rotation @ turns @ rotation.T,
    )


def _clip(clips: tuple[GltfClip, ...], name: str | None) -> GltfClip:
    clips = tuple(clip for clip in clips if clip.times[-1] > clip.times[0])
    names = [clip.name for clip in clips]
    if not clips:
        raise DataError("it holds no animation")
    if name is None and len(clips) > 1:
        raise ConfigError(f"it holds {len(clips)} animations: name one of {', '.join(names)}")
    if name is not None and name not in names:
        raise ConfigError(
            f"it holds no animation '{name}' (there are: {', '.join(names)})"
            + did_you_mean(name, names)
        )
    return clips[0 if name is None else names.index(name)]
