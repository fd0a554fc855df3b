"""How a mesh stands: where its joints are, and how its segments are turned against the template."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.optimize import nnls

from regkit.body import BodyDescription
from regkit.fitting.flesh import Flesh
from regkit.fitting.layout import SegmentFrame
from regkit.geometry.rotation import vector_to_matrix
from regkit.skeleton import SegmentDescription
from regkit.skeleton.description import parents_first
from regkit.skeleton.joints import FixedJoint, HingeJoint
from regkit.system.arrays import Array
from regkit.system.errors import DataError

BENT = np.radians(15.0)
"""A joint that is bent so far shows its axis [rad]."""

STRAIGHT = np.radians(3.0)
"""Bones that include no larger angle go straight on [rad]."""

MIRRORED = 0.02
"""So much better, as a part of the whole, must a mirror image fit to be taken for one."""

_WEAK = 1e-6
"""How much a segment is drawn to where its parent would carry it, against its own directions."""


@dataclass(frozen=True)
class Posture:
    """The joints of a mesh, and the template to compare with.

    Attributes:
        template: The template.
        joints: Where each segment's joint is in the mesh (3,) [m].
    """

    template: BodyDescription
    joints: Mapping[str, Array]

    def root(self) -> tuple[Array, Array]:
        """The axes (3, 3), as columns, and the origin (3,) [m] of the root's frame in the mesh.

        The origin of a root that lies between the joints of its children in the template, as that
        of a pelvis does, lies between them in the mesh; else it is the joint's.

        Raises:
            DataError: If the mesh is the template's mirror image.
        """
        name = parents_first(self.template.segments)[0]
        offsets = np.array([child.offset for child in self._children(name).values()])
        pairs = self._pairs(name, self.joints[name])
        origin = self.joints[name]
        if len(offsets):
            # Shares that are not negative, have the sum one, and meet in the root's origin.
            equations = np.vstack([offsets.T / np.abs(offsets).max(), np.ones(len(offsets))])
            shares, missed = nnls(equations, np.array([0.0, 0.0, 0.0, 1.0]))
            if missed < 1e-3:
                origin = shares @ np.array([self.joints[child] for child in self._children(name)])
                pairs = self._pairs(name, origin)
        rotation, mirrored = _turn(pairs, np.eye(3))
        if mirrored:
            raise DataError(
                f"the joints around '{name}' are a mirror image of the template's: exchange left "
                "and right in the map, or take the template of the other side"
            )
        return rotation, origin

    def frames(self, flesh: Mapping[str, Flesh]) -> dict[str, SegmentFrame]:
        """Returns the frame of every segment, if the joints are in the root's axes.

        A segment is turned until its bones point as the template's do, and otherwise as little as
        it can be against its parent. Where a hinge that goes straight on at rest is bent in the
        mesh, the bend gives its axis. A segment at the end of a limb points to the middle of its
        flesh; one that is fixed goes with its parent.

        Args:
            flesh: That of each segment, in the root's axes.

        Raises:
            DataError: If the end of a limb points the wrong way.
        """
        segments = self.template.segments
        root, *others = parents_first(segments)
        axes = {root: np.eye(3)}
        for name in others:
            segment = segments[name]
            at_rest = vector_to_matrix(np.radians(segment.rotation_deg))
            nominal = axes[segment.parent or root] @ at_rest
            pairs: list[tuple[Array, Array]] = []
            if not isinstance(segment.joint or FixedJoint(), FixedJoint):
                pairs = self._pairs(name, self.joints[name])
                middle = self._middle(name)
                if not self._children(name) and middle is not None:
                    to_flesh = flesh[name].interior.mean(axis=0) - self.joints[name]
                    pairs = [(_unit(middle), _unit(to_flesh))]
                    self._check_end(name, nominal @ pairs[0][0], pairs[0][1])
            axes[name] = _turn(pairs, nominal)[0]
        return {name: SegmentFrame(self.joints[name], axes[name].T) for name in segments}

    def _children(self, name: str) -> dict[str, SegmentDescription]:
        return {own: one for own, one in self.template.segments.items() if one.parent == name}

    def _pairs(self, name: str, origin: Array) -> list[tuple[Array, Array]]:
        """Directions in the template's segment, and the same ones in the mesh."""
        pairs = []
        for child, segment in self._children(name).items():
            way = self.joints[child] - origin
            if np.linalg.norm(segment.offset) > 1e-6 and np.linalg.norm(way) > 1e-6:
                bone = _unit(np.array(segment.offset))
                pairs.append((bone, _unit(way)))
                pairs += self._bend(child, segment, bone, way)
        return pairs

    def _bend(
        self, name: str, segment: SegmentDescription, bone: Array, way: Array
    ) -> list[tuple[Array, Array]]:
        """Returns the axis of a hinge, if the mesh shows it."""
        grandchildren = self._children(name)
        hinge = segment.joint
        if (
            not isinstance(hinge, HingeJoint)
            or len(grandchildren) != 1
            or any(segment.rotation_deg)
        ):
            return []
        ((last, grandchild),) = grandchildren.items()
        further = self.joints[last] - self.joints[name]
        if np.linalg.norm(grandchild.offset) < 1e-6 or np.linalg.norm(further) < 1e-6:
            return []
        sine = np.linalg.norm(np.cross(bone, _unit(np.array(grandchild.offset))))
        bend = np.cross(_unit(way), _unit(further))
        if sine > np.sin(STRAIGHT) or np.linalg.norm(bend) < np.sin(BENT):
            return []
        low, high = hinge.limits_deg or (0.0, 0.0)
        sense = 1.0 if low + high >= 0.0 else -1.0
        return [(sense * np.array(hinge.axis), _unit(bend))]

    def _middle(self, name: str) -> Array | None:
        """The middle of a segment's primitives in the template (3,) [m], if they have one."""
        for by_segment in self.template.shapes.values():
            if by_segment.get(name):
                middle = np.mean([one.moments()[0] for one in by_segment[name]], axis=0)
                return middle if np.linalg.norm(middle) > 1e-6 else None
        return None

    def _check_end(self, name: str, expected: Array, found: Array) -> None:
        if expected @ found < np.cos(np.radians(110.0)):
            raise DataError(
                f"'{name}' points the other way than in the template: are left and right exchanged "
                "in the map, or does a bone belong to the wrong segment?"
            )


def _turn(pairs: list[tuple[Array, Array]], nominal: Array) -> tuple[Array, bool]:
    """Returns the rotation (3, 3) that turns the first of each pair nearest to the second.

    What they leave open stays as in ``nominal``. Also whether a reflection would do it better.

    Source: Kabsch, A solution for the best rotation to relate two sets of vectors, 1976.
    """
    summed = sum((np.outer(goal, start) for start, goal in pairs), np.zeros((3, 3)))
    left, sizes, right = np.linalg.svd(summed + _WEAK * nominal)
    sign = np.sign(np.linalg.det(left @ right))
    return left @ np.diag([1.0, 1.0, sign]) @ right, bool(
        sign < 0.0 and sizes[2] > MIRRORED * sizes[0]
    )


def _unit(vector: Array) -> Array:
    return np.asarray(vector / np.linalg.norm(vector))
