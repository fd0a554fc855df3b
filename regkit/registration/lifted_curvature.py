"""The curvature of a body with parts whose base alone was registered."""

from __future__ import annotations

import numpy as np

from regkit.body.lifting import Lifting
from regkit.interfaces import Curvature, Prior
from regkit.registration.posterior import PoseCurvature
from regkit.skeleton import Pose, Skeleton


def lifted_curvature(
    curvature: Curvature | None, lifting: Lifting, skeleton: Skeleton, pose: Pose, prior: Prior
) -> PoseCurvature | None:
    """Returns the curvature of the whole body; None without one of the base.

    The data tell nothing of the joints of the parts, which are as sure as they were before.

    Args:
        curvature: Curvature of the base.
        lifting: What base and whole have in common.
        skeleton: Skeleton of the whole.
        pose: Pose of the whole.
        prior: What was known of it before the frame.
    """
    if not isinstance(curvature, PoseCurvature):
        return None
    order = np.full(skeleton.dofs, -1)
    order[skeleton.independent_dofs] = np.arange(len(skeleton.independent_dofs))
    own = order[lifting.dofs[lifting.base.skeleton.independent_dofs]]
    count = len(skeleton.independent_dofs)
    gradient, matrix, shown = np.zeros(count), np.zeros((count, count)), np.zeros(count)
    gradient[own], shown[own] = curvature.gradient, curvature.shown
    matrix[np.ix_(own, own)] = curvature.matrix
    informed = prior if curvature.prior is not None else None
    return PoseCurvature(skeleton, pose, gradient, matrix, informed, shown)
