"""Motion of a human figure: where it comes from, and how it is played.

A source is a clip (``clip``), a BVH file (``bvh``), an animation in a glTF file (``gltf``) or poses
that somebody wrote down (``keyframes``). The first three are sampled motions, which ``mending``
repairs; ``shipped`` lists those that ship, and ``config`` is what a user writes.
"""

from regkit_synthesis.motion.config import AnyMotion, ClipConfig, MotionConfig
from regkit_synthesis.motion.motion import Motion, Rig, SourcePose
from regkit_synthesis.motion.played import Placed, Played
from regkit_synthesis.motion.sampled import SampledMotion
from regkit_synthesis.motion.shipped import BVH, CLIPS, KEYFRAMES, shipped_clip

__all__ = [
    "BVH",
    "CLIPS",
    "KEYFRAMES",
    "AnyMotion",
    "ClipConfig",
    "Motion",
    "MotionConfig",
    "Placed",
    "Played",
    "Rig",
    "SampledMotion",
    "SourcePose",
    "shipped_clip",
]
