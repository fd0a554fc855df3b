"""Rigid alignment of two clouds, with any method that registers a rigid body.

The base class of methods of other libraries is in ``rigid_method``.
"""

from regkit.alignment.alignment import Alignment, align
from regkit.alignment.starts import STARTS, read_transform
from regkit.body.cloud import cloud_body, cloud_description
from regkit.clouds.agreement import Agreement, agreement

__all__ = [
    "STARTS",
    "Agreement",
    "Alignment",
    "agreement",
    "align",
    "cloud_body",
    "cloud_description",
    "read_transform",
]
