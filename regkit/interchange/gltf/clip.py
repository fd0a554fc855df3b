"""Animations of a glTF file as bone poses over time.

Source: The Khronos Group, glTF 2.0 Specification, section 3.11 and appendix C (interpolation).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from regkit.geometry.rotation import normalized
from regkit.interchange.gltf.file import GltfFile
from regkit.interchange.gltf.nodes import NodeMotion, Nodes
from regkit.interchange.gltf.slerp import slerp
from regkit.system.arrays import Array

_WIDTHS = {"translation": 3, "rotation": 4, "scale": 3}


@dataclass(frozen=True)
class GltfChannel:
    """The animation of one property of a node.

    Attributes:
        node: Index of the node.
        path: ``translation``, ``rotation`` or ``scale``.
        interpolation: ``LINEAR``, ``STEP`` or ``CUBICSPLINE``.
        times: Times of the keyframes, (K,) [s].
        values: Values at the keyframes, (K, C); for a spline (K, 3, C): in-tangent, value,
            out-tangent.
    """

    node: int
    path: str
    interpolation: str
    times: Array
    values: Array

    def at(self, time: float) -> Array:
        """Returns the value (C,) at ``time`` [s], constant outside of the keyframes."""
        time = float(np.clip(time, self.times[0], self.times[-1]))
        left = int(np.searchsorted(self.times, time, side="right")) - 1
        right = min(left + 1, len(self.times) - 1)
        step = float(self.times[right] - self.times[left])
        share = (time - float(self.times[left])) / step if step > 0.0 else 0.0
        if self.interpolation == "CUBICSPLINE":
            return self._spline(left, right, share, step)
        start, end = self.values[left], self.values[right]
        if self.interpolation == "STEP":
            return np.asarray(start)
        if self.path == "rotation":
            return slerp(start, end, share)
        return np.asarray((1.0 - share) * start + share * end)

    def _spline(self, left: int, right: int, share: float, step: float) -> Array:
        """Returns the value of the Hermite spline between two keyframes, appendix C.5."""
        square, cube = share**2, share**3
        start, leaving = self.values[left, 1], step * self.values[left, 2]
        end, arriving = self.values[right, 1], step * self.values[right, 0]
        value = (
            (2.0 * cube - 3.0 * square + 1.0) * start
            + (cube - 2.0 * square + share) * leaving
            + (3.0 * square - 2.0 * cube) * end
            + (cube - square) * arriving
        )
        return normalized(value) if self.path == "rotation" else np.asarray(value)


@dataclass(frozen=True)
class GltfClip:
    """One animation.

    Attributes:
        name: Its name in the file, or a generated one.
        times: Times of all keyframes, ascending, (K,) [s].
        channels: Its channels.
        nodes: The nodes of the file.
        joints: Node of each bone, (J,).
        frames: ``T_node_bone``, (J, 4, 4).
    """

    name: str
    times: Array
    channels: tuple[GltfChannel, ...]
    nodes: Nodes
    joints: tuple[int, ...]
    frames: Array

    @property
    def duration(self) -> float:
        """Time of the last keyframe [s]; the clip starts at zero."""
        return float(self.times[-1])

    def at(self, time: float) -> Array:
        """Returns ``T_scene_bone`` (J, 4, 4) at ``time`` [s], for ``SkinnedMesh.posed``."""
        motion: NodeMotion = self.nodes.given.copy()
        moving = {
            "translation": motion.translations,
            "rotation": motion.rotations,
            "scale": motion.scales,
        }
        for channel in self.channels:
            moving[channel.path][channel.node] = channel.at(time)
        return np.asarray(self.nodes.placed(motion)[list(self.joints)] @ self.frames)

    @classmethod
    def all_of(
        cls, file: GltfFile, nodes: Nodes, joints: list[int], frames: Array
    ) -> tuple[GltfClip, ...]:
        """Returns all animations of a file that move nodes.

        Args:
            file: The file.
            nodes: Its nodes.
            joints: Node of each bone, (J,).
            frames: ``T_node_bone``, (J, 4, 4).

        Raises:
            DataError: If an animation is invalid.
        """
        clips = []
        for index, animation in enumerate(file.content.animations or ()):
            try:
                targets = [
                    (file.item(animation.samplers, channel.sampler, "sampler"), channel.target)
                    for channel in animation.channels
                    if channel.target.path in _WIDTHS and channel.target.node is not None
                ]
                channels = tuple(_channel(file, *pair) for pair in targets)
            # A file may violate the format in many ways.
            except (AttributeError, IndexError, TypeError) as error:
                raise file.wrong(f"animation {index} cannot be read ({error})") from None
            if channels:
                times = np.unique(np.concatenate([channel.times for channel in channels]))
                name = str(animation.name or f"animation_{index}")
                clips.append(cls(name, times, channels, nodes, tuple(joints), frames))
        return tuple(clips)


def _channel(file: GltfFile, sampler: Any, target: Any) -> GltfChannel:
    file.item(file.content.nodes, target.node, "node")
    interpolation = str(sampler.interpolation or "LINEAR")
    if interpolation not in ("LINEAR", "STEP", "CUBICSPLINE"):
        raise file.wrong(f"an animation has the interpolation '{interpolation}'")
    times = file.floats(sampler.input)[:, 0]
    if not len(times) or (np.diff(times) <= 0.0).any():
        raise file.wrong(
            f"the keyframes of node {target.node} are missing or not in ascending order"
        )
    width = _WIDTHS[target.path]
    shape = (len(times), 3, width) if interpolation == "CUBICSPLINE" else (len(times), width)
    values = file.floats(sampler.output)
    if values.size != np.prod(shape):
        raise file.wrong(
            f"the {target.path} of node {target.node} has {len(times)} keyframes and "
            f"{values.size} numbers; it needs {np.prod(shape)}"
        )
    return GltfChannel(target.node, target.path, interpolation, times, values.reshape(shape))
