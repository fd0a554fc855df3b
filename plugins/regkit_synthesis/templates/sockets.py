"""Where the hands of a person's template are: sockets for the templates of hands."""

from __future__ import annotations

import numpy as np
import scipy

from regkit.body.parts import SocketDescription
from regkit.body.vectors import rounded
from regkit.fitting.layout import Layout
from regkit.geometry.rigid import transformed
from regkit.geometry.rotation import from_matrix, to_vector
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array
from regkit_synthesis import assets
from regkit_synthesis.templates import mirror
from regkit_synthesis.templates.hand_layout import PALM, hand_layout
from regkit_synthesis.templates.human_limits import WRIST


def hand_sockets(
    mesh: SkinnedMesh, layout: Layout, hand_size: float
) -> dict[str, SocketDescription]:
    """Returns the sockets of both hands, as the palm of anny's hand lies in one of anny's bodies.

    Args:
        mesh: One of anny's bodies.
        layout: Its segments.
        hand_size: Length of the hand's template [m].
    """
    hand, own = assets.average_hand(), hand_layout(assets.average_hand())
    # The vertices of anny's hand are some of those of its body, in the same places.
    found = scipy.spatial.KDTree(assets.average_human().vertices).query(hand.vertices)
    same = np.asarray(found[1])
    strongest = hand.indices[np.arange(len(hand.vertices)), hand.weights.argmax(axis=1)]
    palm = [own.owners[hand.labels[bone]] == PALM for bone in strongest]
    start = transformed(own.T_template_mesh, hand.vertices[palm])
    goal = transformed(layout.T_template_mesh, mesh.vertices[same[palm]])
    rotation, scale = _similarity(start, layout.frames["right_hand"].local(goal))
    right = rounded(np.degrees(to_vector(from_matrix(rotation))), 1)
    size = round(scale * hand_size, 4)
    return {
        "left_hand": SocketDescription(
            rotation_deg=mirror.turn(right), joint=mirror.joint(WRIST, str), size=size
        ),
        "right_hand": SocketDescription(rotation_deg=right, joint=WRIST, size=size),
    }


def _similarity(start: Array, goal: Array) -> tuple[Array, float]:
    """Returns rotation (3, 3) and scale of the similarity of least squares (Umeyama, 1991)."""
    start, goal = start - start.mean(axis=0), goal - goal.mean(axis=0)
    left, values, right = np.linalg.svd(goal.T @ start)
    signs = np.array([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    return left * signs @ right, float((values * signs).sum() / (start**2).sum())
