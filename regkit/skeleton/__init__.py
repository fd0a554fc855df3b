"""Skeletons: trees of segments connected by free, ball, hinge, universal and fixed joints.

``description`` and ``joints`` hold the YAML form, ``compile`` turns it into a ``Skeleton``; a
``Pose`` is a configuration, a ``Placement`` its forward kinematics and Jacobian, and ``Limits`` and
``Couplings`` are the joint limits. Functions in ``compiled_*`` are Numba loops.
"""

from regkit.skeleton.couplings import Couplings
from regkit.skeleton.description import SegmentDescription, SkeletonDescription
from regkit.skeleton.limits import Limits
from regkit.skeleton.mirroring import Mirroring
from regkit.skeleton.placement import Placement
from regkit.skeleton.pose import Pose, PoseDescription
from regkit.skeleton.skeleton import Skeleton

__all__ = [
    "Couplings",
    "Limits",
    "Mirroring",
    "Placement",
    "Pose",
    "PoseDescription",
    "SegmentDescription",
    "Skeleton",
    "SkeletonDescription",
]
