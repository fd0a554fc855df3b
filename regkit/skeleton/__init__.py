"""Skeletons: trees of segments joined by free, ball, hinge, universal and fixed joints."""

from regkit.skeleton.couplings import Couplings
from regkit.skeleton.description import SegmentDescription, SkeletonDescription
from regkit.skeleton.limits import Limits
from regkit.skeleton.placement import Placement
from regkit.skeleton.pose import Pose, PoseDescription
from regkit.skeleton.skeleton import Skeleton

__all__ = [
    "Couplings",
    "Limits",
    "Placement",
    "Pose",
    "PoseDescription",
    "SegmentDescription",
    "Skeleton",
    "SkeletonDescription",
]
