"""The human template: what is fitted to the mesh."""

from __future__ import annotations

import numpy as np

from regkit.body import BodyDescription, GaussianParameters
from regkit.body.deformation import REFLECT
from regkit.body.description import SizeDescription
from regkit.body.vectors import rounded
from regkit.fitting.flesh import Flesh, flesh_of
from regkit.fitting.layout import Layout
from regkit.geometry.rigid import transformed
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.skeleton import PoseDescription, SegmentDescription
from regkit.skeleton.joints import FixedJoint
from regkit.system.arrays import Array
from regkit_synthesis.bodies.bodies import human_landmarks
from regkit_synthesis.templates import mirror
from regkit_synthesis.templates.capsules import fitted
from regkit_synthesis.templates.gaussians import balls, gaussian, symmetric_balls
from regkit_synthesis.templates.human_layout import (
    BALLS,
    BONES,
    KINECT,
    MARKERS,
    PARENTS,
    PIECES,
    human_layout,
)
from regkit_synthesis.templates.human_limits import JOINTS, SOURCES, STANCES
from regkit_synthesis.templates.sockets import hand_sockets

SPACING = 0.008
"""Distance of the points inside the mesh [m]: some 100,000 points."""

SHORTEST, TALLEST = 1.45, 2.0
"""Heights of adults that are tried where none is given [m]."""


HAND = 0.1858
"""Length of the template of a hand, which is that of the neutral body [m]."""


def human(
    mesh: SkinnedMesh, who: str = "A person of average proportions", body: str = "the neutral body"
) -> BodyDescription:
    """The human template of a mesh that is its own mirror image.

    The left side is fitted and mirrored; what lies in the middle is fitted together with its mirror
    image.

    Args:
        mesh: The body.
        who: Whom the template's title names.
        body: Which of anny's bodies the mesh is.
    """
    layout = human_layout(mesh)
    flesh = {
        name: both_sides(own) if name in ("pelvis", "chest", "head") else own
        for name, own in flesh_of(mesh, layout, SPACING).items()
    }
    heights = layout.neutral(mesh)[:, 1]
    left = {name: _segment(name, mesh, layout, flesh[name]) for name in BONES}
    sog = {name: _balls(name, flesh[name]) for name in BONES}
    gsog: dict[str, tuple[GaussianParameters, ...]] = {
        name: (gaussian(flesh[name].interior),) for name in BONES if name != "left_hand"
    }
    # The hand is fixed to the forearm, and one Gaussian stands for both.
    gsog["left_forearm"] = (gaussian(_forearm_and_hand(layout, flesh)),)
    return BodyDescription(
        title=f"{who}, 15 segments, standing with the arms at the sides",
        sources=tuple(source.format(body=body) for source in SOURCES),
        size=SizeDescription(
            name="height",
            value=round(float(heights.max() - heights.min()), 4),
            range=(SHORTEST, TALLEST),
        ),
        upright=True,
        segments=_both_segments(left),
        stances={name: PoseDescription(joints=joints) for name, joints in STANCES.items()},
        shapes={"gsog": _both_gaussians(gsog), "sog": _both_gaussians(sog)},
        sockets=hand_sockets(mesh, layout, HAND),
    )


def both_sides(flesh: Flesh) -> Flesh:
    """The flesh of a segment in the middle, and its mirror image."""
    left = flesh.interior[flesh.interior[:, 0] > 0.0]
    return Flesh(
        np.concatenate([left, left * REFLECT]),
        np.concatenate([flesh.surface, flesh.surface * REFLECT]),
        np.concatenate([flesh.areas, flesh.areas]),
    )


def right_of(name: str) -> str:
    """The name of what mirrors ``name``."""
    return name.replace("left_", "right_")


def _segment(name: str, mesh: SkinnedMesh, layout: Layout, flesh: Flesh) -> SegmentDescription:
    frame, parent = layout.frames[name], PARENTS[name]
    markers = {}
    for marker, landmark in human_landmarks(mesh).items():
        if MARKERS.get(marker) == name:
            place = frame.local(transformed(layout.T_template_mesh, landmark.position[None]))[0]
            markers[marker] = rounded(place if "left" in marker else place * [0.0, 1.0, 1.0])
    for marker, (landmark_name, away) in KINECT.items():
        if MARKERS[landmark_name] == name:
            markers[marker] = rounded(np.array(markers[landmark_name]) + away)
    offset = np.zeros(3) if parent is None else layout.frames[parent].local(frame.origin)
    return SegmentDescription(
        parent=parent,
        offset=rounded(offset),
        joint=JOINTS.get(name, FixedJoint()),
        capsules=fitted(PIECES[name], flesh, scale=0.01),
        markers=markers,
    )


def _balls(name: str, flesh: Flesh) -> tuple[GaussianParameters, ...]:
    pairs, single = BALLS[name]
    if name.startswith("left_"):
        return balls(flesh.interior, single)
    return symmetric_balls(flesh.interior, pairs, single)


def _forearm_and_hand(layout: Layout, flesh: dict[str, Flesh]) -> Array:
    forearm, hand = layout.frames["left_forearm"], layout.frames["left_hand"]
    moved_hand = flesh["left_hand"].interior + forearm.local(hand.origin)
    return np.concatenate([flesh["left_forearm"].interior, moved_hand])


def _both_segments(left: dict[str, SegmentDescription]) -> dict[str, SegmentDescription]:
    both = {}
    for name, segment in left.items():
        both[name] = segment
        if name.startswith("left_"):
            both[right_of(name)] = mirror.segment(segment, right_of)
    return both


def _both_gaussians(
    left: dict[str, tuple[GaussianParameters, ...]],
) -> dict[str, tuple[GaussianParameters, ...]]:
    both = {}
    for name, several in left.items():
        both[name] = several
        if name.startswith("left_"):
            both[right_of(name)] = tuple(map(mirror.primitive, several))
    return both
