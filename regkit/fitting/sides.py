"""Whether a mesh is the template's mirror image: exchanged sides, or the hand of the other side."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from regkit.body import BodyDescription
from regkit.fitting.posture import Posture
from regkit.geometry.rigid import inverse, rigid, transformed
from regkit.geometry.rotation import vector_to_matrix
from regkit.skeleton.description import parents_first
from regkit.system.arrays import Array
from regkit.system.errors import DataError

CLEAR = 0.85
"""A mirror image whose strain is below this fraction of the mesh's is the better one.

Of three people, a figure in four poses, and three hands, the wrong side's strain is 1.3 to 12 times
that of the right side."""

LEAST = 0.1
"""Smallest difference of strains that counts [rad^2]; symmetric bodies have none."""


def check_sides(
    template: BodyDescription, joints: Mapping[str, Array], centres: Mapping[str, Array]
) -> None:
    """Checks that the template bends less to take the pose of the mesh than that of its mirror.

    A map that exchanges left and right turns the body back to front, so that feet, elbows and knees
    have to turn half around. This is independent of single limbs, which may have any pose.

    Args:
        template: The template.
        joints: Position of each segment's joint in the mesh, (3,) [m].
        centres: Centre of each segment's flesh, (3,) [m].

    Raises:
        DataError: If the mirror image is clearly the better one.
    """
    mirror = np.array([-1.0, 1.0, 1.0])
    own, mirrored = (
        strain(
            template,
            {name: signs * at for name, at in joints.items()},
            {name: signs * at for name, at in centres.items()},
        )
        for signs in (np.ones(3), mirror)
    )
    if mirrored < CLEAR * own and own - mirrored > LEAST:
        raise DataError(
            "the mesh is rather a mirror image of the template: exchange left and right in the "
            f"map, or use the template of the other side (strain {own:.3g}, mirrored "
            f"{mirrored:.3g})"
        )


def strain(
    template: BodyDescription, joints: Mapping[str, Array], centres: Mapping[str, Array]
) -> float:
    """Returns how far a template bends to take a mesh's pose [rad^2].

    It is the sum of the squared angles between segments and their parents, against the rest pose,
    and of the squared distances between directions of bones that a rotation cannot align.

    Args:
        template: The template.
        joints: Position of each segment's joint in the mesh, (3,) [m].
        centres: Centre of each segment's flesh, (3,) [m].
    """
    axes, origin, _ = Posture(template, joints).aligned_root()
    T_template_mesh = inverse(rigid(axes, origin))
    order = parents_first(template.segments)
    placed, middles = (
        {name: transformed(T_template_mesh, at[None])[0] for name, at in one.items()}
        for one in (joints, centres)
    )
    posture = Posture(template, placed | {order[0]: np.zeros(3)})
    rotations = posture.rotations(middles)
    total = 0.0
    for name in order:
        segment, own = template.segments[name], rotations[name]
        if segment.parent is not None:
            rest = vector_to_matrix(np.radians(segment.rotation_deg))
            cosine = (np.trace((rotations[segment.parent] @ rest).T @ own) - 1.0) / 2.0
            total += float(np.arccos(np.clip(cosine, -1.0, 1.0))) ** 2
        for start, goal in posture.pairs(name, posture.joints[name]):
            total += float(np.sum((own @ start - goal) ** 2))
    return total
