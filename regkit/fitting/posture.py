"""The posture of a mesh: its joints, and the rotations of its segments against the template."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import scipy

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
"""A joint bent by at least this angle reveals its axis [rad]."""

STRAIGHT = np.radians(3.0)
"""Bones with at most this angle between them count as straight [rad]."""

MIRRORED = 0.02
"""A fit counts as mirrored if a reflection is better by more than this fraction."""

_WEAK = 1e-6
"""Weight of the parent's rotation relative to the segment's own directions."""


@dataclass(frozen=True)
class Posture:
    """The joints of a mesh, compared with a template.

    Attributes:
        template: The template.
        joints: Position of each segment's joint in the mesh, (3,) [m].
    """

    template: BodyDescription
    joints: Mapping[str, Array]

    def root(self) -> tuple[Array, Array]:
        """Returns axes (3, 3), as columns, and origin (3,) [m] of the root's frame in the mesh.

        If the template's root lies between the joints of its children, such as a pelvis, its origin
        lies between them in the mesh, too; otherwise the origin is the root's joint.

        Raises:
            DataError: If the mesh is the template's mirror image.
        """
        rotation, origin, mirrored = self.aligned_root()
        if mirrored:
            name = parents_first(self.template.segments)[0]
            raise DataError(
                f"the joints around '{name}' are a mirror image of the template's: exchange left "
                "and right in the map, or use the template of the other side"
            )
        return rotation, origin

    def aligned_root(self) -> tuple[Array, Array, bool]:
        """Returns axes and origin of the root's frame, and whether a reflection is better."""
        name = parents_first(self.template.segments)[0]
        shares = self.root_shares()
        origin = np.sum([share * self.joints[one] for one, share in shares.items()], axis=0)
        rotation, mirrored = _aligning_rotation(self.pairs(name, origin), np.eye(3))
        return rotation, origin, mirrored

    def root_shares(self) -> dict[str, float]:
        """Returns the shares of the segments' joints in the origin of the root's frame.

        They sum to one, and none is negative.
        """
        name = parents_first(self.template.segments)[0]
        children = self._children(name)
        offsets = np.array([child.offset for child in children.values()])
        if len(offsets):
            equations = np.vstack([offsets.T / np.abs(offsets).max(), np.ones(len(offsets))])
            shares, missed = scipy.optimize.nnls(equations, np.array([0.0, 0.0, 0.0, 1.0]))
            if missed < 1e-3:
                return dict(zip(children, shares.tolist(), strict=True))
        return {name: 1.0}

    def frames(self, flesh: Mapping[str, Flesh]) -> dict[str, SegmentFrame]:
        """Returns the frame of every segment; the joints must be in the root's axes.

        A segment's rotation aligns its bones with the template's, with the least rotation against
        its parent. A bent hinge whose bones are straight at rest also reveals its axis. A segment
        at the end of a limb points to the centre of its flesh. A fixed segment follows its parent.

        Args:
            flesh: Samples of each segment, in the root's axes.

        Raises:
            DataError: If the end of a limb points the wrong way.
        """
        centres = {name: part.interior.mean(axis=0) for name, part in flesh.items()}
        axes = self.rotations(centres)
        for name in self.template.segments:
            self._check_end(name, axes, centres)
        return {name: SegmentFrame(self.joints[name], own.T) for name, own in axes.items()}

    def rotations(self, centres: Mapping[str, Array]) -> dict[str, Array]:
        """Returns the rotation (3, 3) of every segment in the root's axes; see ``frames``.

        Args:
            centres: Centre of each segment's flesh, in the root's axes, (3,) [m].
        """
        segments = self.template.segments
        root, *others = parents_first(segments)
        axes = {root: np.eye(3)}
        for name in others:
            pairs: list[tuple[Array, Array]] = []
            if not isinstance(segments[name].joint or FixedJoint(), FixedJoint):
                end = self._end(name, centres)
                pairs = self.pairs(name, self.joints[name]) if end is None else [end]
            axes[name] = _aligning_rotation(pairs, self._nominal(name, axes))[0]
        return axes

    def _nominal(self, name: str, axes: Mapping[str, Array]) -> Array:
        """Returns the rotation (3, 3) of a segment that is at rest against its parent."""
        segment = self.template.segments[name]
        at_rest = vector_to_matrix(np.radians(segment.rotation_deg))
        return np.asarray(axes[segment.parent or ""] @ at_rest)

    def _end(self, name: str, centres: Mapping[str, Array]) -> tuple[Array, Array] | None:
        """Returns the directions of a limb's end in template and mesh; None for other segments."""
        middle = self._middle(name)
        if self._children(name) or middle is None:
            return None
        return _unit(middle), _unit(centres[name] - self.joints[name])

    def _children(self, name: str) -> dict[str, SegmentDescription]:
        return {own: one for own, one in self.template.segments.items() if one.parent == name}

    def pairs(self, name: str, origin: Array) -> list[tuple[Array, Array]]:
        """Returns pairs of directions: in the template's segment, and in the mesh."""
        pairs = []
        for child, segment in self._children(name).items():
            direction = self.joints[child] - origin
            if np.linalg.norm(segment.offset) > 1e-6 and np.linalg.norm(direction) > 1e-6:
                bone = _unit(np.array(segment.offset))
                pairs.append((bone, _unit(direction)))
                pairs += self._bend(child, segment, bone, direction)
        return pairs

    def _bend(
        self, name: str, segment: SegmentDescription, bone: Array, direction: Array
    ) -> list[tuple[Array, Array]]:
        """Returns a hinge's axis in template and mesh if the mesh reveals it, else nothing."""
        grandchildren = self._children(name)
        hinge = segment.joint
        if (
            not isinstance(hinge, HingeJoint)
            or len(grandchildren) != 1
            or any(segment.rotation_deg)
        ):
            return []
        ((last, grandchild),) = grandchildren.items()
        next_direction = self.joints[last] - self.joints[name]
        if np.linalg.norm(grandchild.offset) < 1e-6 or np.linalg.norm(next_direction) < 1e-6:
            return []
        sine = np.linalg.norm(np.cross(bone, _unit(np.array(grandchild.offset))))
        bend = np.cross(_unit(direction), _unit(next_direction))
        if sine > np.sin(STRAIGHT) or np.linalg.norm(bend) < np.sin(BENT):
            return []
        low, high = hinge.limits_deg or (0.0, 0.0)
        sign = 1.0 if low + high >= 0.0 else -1.0
        return [(sign * np.array(hinge.axis), _unit(bend))]

    def _middle(self, name: str) -> Array | None:
        """Returns the centre (3,) [m] of a segment's primitives in the template, if it has any."""
        for by_segment in self.template.shapes.values():
            if by_segment.get(name):
                middle = np.mean([one.moments()[0] for one in by_segment[name]], axis=0)
                return middle if np.linalg.norm(middle) > 1e-6 else None
        return None

    def _check_end(
        self, name: str, axes: Mapping[str, Array], centres: Mapping[str, Array]
    ) -> None:
        segment = self.template.segments[name]
        end = self._end(name, centres)
        if (
            end is None
            or segment.parent is None
            or isinstance(segment.joint or FixedJoint(), FixedJoint)
        ):
            return
        if self._nominal(name, axes) @ end[0] @ end[1] < np.cos(np.radians(110.0)):
            raise DataError(
                f"'{name}' points the other way than in the template: are left and right exchanged "
                "in the map, or does a bone belong to the wrong segment?"
            )


def _aligning_rotation(pairs: list[tuple[Array, Array]], nominal: Array) -> tuple[Array, bool]:
    """Returns the rotation (3, 3) that aligns pairs best, and whether a reflection is better.

    Undetermined directions follow ``nominal``.

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
