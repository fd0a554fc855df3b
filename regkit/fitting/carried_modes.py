"""Shape modes of a mesh, carried over to the template that is fitted to it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from regkit.body.modes import Modes
from regkit.system.arrays import Array, Indices


def carried_modes(
    modes: Modes,
    R_template_mesh: Array,
    bones: Mapping[str, int],
    root: Mapping[str, float],
    kept: Indices,
) -> Modes:
    """Returns the modes of the segments and of the kept vertices, in the template's axes.

    Args:
        modes: The modes of the mesh's bones and vertices, in its axes.
        R_template_mesh: Rotation from the mesh's axes to the template's, (3, 3).
        bones: First bone of each segment, whose start is the segment's joint; the root first.
        root: Shares of the segments' joints in the origin of the root, by segment.
        kept: Indices of the vertices that the template's skin has.
    """
    joints = {name: modes.joints[:, bone] for name, bone in bones.items()}
    first = next(iter(joints))
    joints[first] = np.sum([share * joints[name] for name, share in root.items()], axis=0)
    return replace(
        modes,
        labels=tuple(joints),
        joints=np.stack(list(joints.values()), axis=1) @ R_template_mesh.T,
        vertices=modes.vertices[:, kept] @ R_template_mesh.T,
    )
