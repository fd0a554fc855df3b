"""A person who moves before a camera as in a recorded clip."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import radians

import numpy as np

from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array
from regkit_synthesis.bodies.body_map import body_map
from regkit_synthesis.bodies.retarget import retargeted
from regkit_synthesis.motion.motion import Motion
from regkit_synthesis.motion.played import Played
from regkit_synthesis.motion.shipped import shipped_clip
from regkit_synthesis.recordings.scene import SR4000, Scene

_R_CAMERA_BODY = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""From x left, y backward, z up to x right, y down, z forward: the body looks into the camera."""

_BODY = body_map("anny_cmu")
"""The people of the sample recordings and of the suite have anny's CMU rig."""


@dataclass(frozen=True)
class PersonTake:
    """How a person moves, and from where that is seen.

    Attributes:
        clip: Name of the recorded clip.
        heading: How far the clip's forward direction is turned from the camera, to its right [deg].
        place: (3,) where the clip begins on the ground, from a level camera: to the right, down and
            forward [m].
        frames: How many images are taken.
        way: The share of the clip's mean velocity that is kept; the rest is taken out, as on a
            treadmill, so that the body stays in the image.
        start: Where in the clip the first image is taken [s].
        speed: How fast the clip is played; 1 is as recorded.
        repeated: Whether the clip is bent to go on from its beginning, although it was not recorded
            so.
        tilt: How far the camera looks down [deg].
        noise: Standard deviation of the depth [m].
    """

    clip: str
    heading: float
    place: tuple[float, float, float]
    frames: int = 60
    way: float = 0.2
    start: float = 0.0
    speed: float = 1.0
    repeated: bool = False
    tilt: float = 0.0
    noise: float = 0.008

    def scene(self, name: str, body: str, mesh: SkinnedMesh) -> Scene:
        """The scene, which is called ``name``, with a mesh that is ``body`` of anny."""
        clip = shipped_clip(self.clip)
        motion = clip.looped() if self.repeated else clip
        return Scene(
            name=name,
            source=(
                f"Rendered by regkit_synthesis: {body} of anny (MakeHuman and MPFB2), moved"
                f" by humanoid3d_{self.clip} of DeepMimic, as shipped with pybullet"
            ),
            licence="CC0-1.0 (body), MIT and zlib (motion)",
            mesh=mesh,
            landmarks=_BODY.landmarks(mesh),
            bone_poses=self._bone_poses(Played.of(motion, self.start, self.speed, self.way), mesh),
            sensor=replace(SR4000, noise=self.noise),
            frames=self.frames,
        )

    def _bone_poses(self, motion: Motion, mesh: SkinnedMesh) -> Callable[[float], Array]:
        """The bone poses ``T_camera_bone`` (J, 4, 4) at a time [s]."""
        bone_poses = retargeted(motion, mesh, _BODY)
        tilt = rigid(vector_to_matrix(np.array([radians(self.tilt), 0.0, 0.0])), np.zeros(3))
        turn = vector_to_matrix(np.array([0.0, 0.0, radians(self.heading)]))
        T_camera_ground = tilt @ rigid(_R_CAMERA_BODY @ turn, np.array(self.place))
        return lambda time: np.asarray(T_camera_ground @ bone_poses(time))
