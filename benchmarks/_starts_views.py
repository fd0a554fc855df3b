"""Cameras around a body, and what they see of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np
from _starts_shots import Shots

from regkit.geometry.rotation import to_matrix
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.sensors import Sensor
from regkit.system.arrays import Array
from regkit_synthesis.bodies.landmarks import Landmark, some_vertices
from regkit_synthesis.recordings.scene import SR4000, Scene
from regkit_synthesis.viewpoint import Viewpoint


def view(heading: float, elevation: float, roll: float, surface: Array) -> Array:
    """Returns ``T_camera_ground`` (4, 4) of the nearest camera that sees a body whole.

    Args:
        heading: Rotation of the body from the direction to the camera [deg].
        elevation: Downward pitch of the camera [deg].
        roll: Counter-clockwise rotation of the camera about its optical axis [deg].
        surface: Points of the body over time, in ground axes, (N, 3) [m].
    """
    # In a square image with the real one's height a body stays whole under all rolls.
    camera, side = SR4000.camera, SR4000.camera.height
    square = replace(camera, width=side, cx=camera.cy)
    viewpoint = Viewpoint(heading_deg=heading, elevation_deg=elevation, roll_deg=-roll)
    return viewpoint.placed(square, lambda: surface)


def surface(mesh: SkinnedMesh, poses: Sequence[Array]) -> Array:
    """Returns points (N, 3) [m] some centimetres apart on the skin in all poses (J, 4, 4)."""
    skin = some_vertices(mesh, np.arange(0, len(mesh.vertices), 8))
    return np.concatenate([skin.posed(pose) for pose in poses])


def seen(
    mesh: SkinnedMesh,
    landmarks: Mapping[str, Landmark],
    poses: Sequence[Array],
    sensor: Sensor,
    random: Callable[[int], np.random.Generator],
) -> Shots:
    """Returns what a camera measures of a body.

    Args:
        mesh: The body.
        landmarks: Its joints by name.
        poses: Bone poses ``T_camera_bone`` (J, 4, 4) in each frame.
        sensor: The camera.
        random: Function that returns the random generator of a frame's noise.
    """
    scene = Scene(
        name="body",
        source="",
        licence="",
        mesh=mesh,
        landmarks=landmarks,
        bone_poses=lambda frame: poses[round(frame)],
        sensor=sensor,
        frames=len(poses),
        fps=1.0,
    )
    found = scene.rendered(random)
    return Shots(found.joints, found.truth, found.camera, found.depth, found.depth_scale)


def random_rotations(count: int, seed: int) -> Array:
    """Returns uniformly distributed rotations (N, 3, 3)."""
    quaternions = np.random.default_rng(seed).normal(size=(count, 4))
    return to_matrix(quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True))
