"""Motion of a human figure: sources of motion, and their playback.

A source is a clip (``clip``), a BVH file (``bvh``), an animation in a glTF file (``gltf``) or
keyframes (``keyframes``). The first three are sampled motions (``sampled``), which ``mending``
repairs. ``played`` changes speed and place, ``shipped`` lists the shipped motions, and ``config``
is the YAML form.
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
