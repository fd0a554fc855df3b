"""Rigid alignment of two clouds, with any method that registers a rigid body.

The base class of methods of other libraries is in ``rigid_method``.
"""

from regkit.alignment.alignment import Alignment, align
from regkit.alignment.contest import Rival
from regkit.alignment.joint_judgement import judged_all
from regkit.alignment.judgement import MIN_FITNESS, judged
from regkit.alignment.pose_graph import AlignedPair, JointAlignment, align_all
from regkit.alignment.starts import STARTS, read_transform
from regkit.body.cloud import cloud_body, cloud_description
from regkit.clouds.agreement import Agreement, agreement

__all__ = [
    "MIN_FITNESS",
    "STARTS",
    "Agreement",
    "AlignedPair",
    "Alignment",
    "JointAlignment",
    "Rival",
    "agreement",
    "align",
    "align_all",
    "cloud_body",
    "cloud_description",
    "judged",
    "judged_all",
    "read_transform",
]
