"""The shape of a mesh in terms of a template: proportions, offsets and shapes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy

from regkit.body import BodyDescription, ShapeParameters
from regkit.body.groups import Groups
from regkit.body.proportions import Proportions
from regkit.body.vectors import rounded
from regkit.fitting.clusters import clusters
from regkit.fitting.flesh import Flesh
from regkit.fitting.layout import Layout
from regkit.skeleton import SegmentDescription
from regkit.skeleton.description import parents_first
from regkit.skeleton.joints import FixedJoint
from regkit.system.arrays import Array


@dataclass(frozen=True)
class MeshShape:
    """The shape of a mesh in terms of a template.

    Attributes:
        template: The template.
        layout: Division of the mesh into the template's segments.
        parts: Samples of each segment, in the template's axes.
        added: Parameter classes of further shape models, by kind: each segment gets one primitive.
    """

    template: BodyDescription
    layout: Layout
    parts: Mapping[str, Flesh]
    added: Mapping[str, type[ShapeParameters]]

    def description(self) -> BodyDescription:
        """Returns the template with the mesh's joints and shapes, everything else stretched."""
        stretched = self.proportions().applied(self.template)
        segments = {name: self._segment(name, one) for name, one in stretched.segments.items()}
        return stretched.model_copy(update={"segments": segments, "shapes": self.shapes})

    @cached_property
    def shapes(self) -> dict[str, dict[str, tuple[ShapeParameters, ...]]]:
        """Fitted primitives by list and by segment."""
        listed = {
            key: {name: self._fitted(key, name, own) for name, own in by_segment.items()}
            for key, by_segment in self.template.shapes.items()
        }
        return listed | {
            kind: {
                name: (parameters.fitted(self.layout.frames[name].local(part.interior)),)
                for name, part in self.parts.items()
            }
            for kind, parameters in self.added.items()
        }

    def proportions(self) -> Proportions:
        """Returns the mean length and girth factors of each group of segments."""
        groups = Groups.of(self.template)
        order = parents_first(self.template.segments)
        factors = np.array(
            [self._factors(name, bone) for name, bone in zip(order, groups.bones, strict=True)]
        )
        means = [
            factors[groups.of_segments == index].mean(axis=0) for index in range(len(groups.names))
        ]
        lengths, girths = np.array(means).T
        return Proportions(groups, lengths, girths)

    def _factors(self, name: str, bone: Array) -> tuple[float, float]:
        """Returns a segment's length factor along its bone and girth factor across it."""
        keys = [key for key, own in self.template.shapes.items() if own.get(name)]
        if not keys:
            return 1.0, 1.0
        before = _mixture(self.template.shapes[keys[0]][name])
        after = _mixture(self.shapes[keys[0]][name])
        across = np.eye(3) - np.outer(bone, bone)
        girth = float(np.sqrt(np.sum(across * after) / np.sum(across * before)))
        children = [own for own, one in self.template.segments.items() if one.parent == name]
        if not bone.any():
            return girth, girth
        if children:
            ends = np.sum([self.template.segments[child].offset for child in children], axis=0)
            reached = np.sum([self._offset(child) for child in children], axis=0)
            return float(bone @ reached / (bone @ ends)), girth
        return float(np.sqrt((bone @ after @ bone) / (bone @ before @ bone))), girth

    def _segment(self, name: str, stretched: SegmentDescription) -> SegmentDescription:
        """Returns a segment with the mesh's joint, and with markers moved along with joints."""
        own = self.template.segments[name]
        markers = dict(stretched.markers)
        for marker, at in own.markers.items():
            for child, segment in self.template.segments.items():
                if segment.parent == name and np.allclose(at, segment.offset, atol=1e-6):
                    markers[marker] = rounded(self._offset(child))
        offset = own.offset if own.parent is None else rounded(self._offset(name))
        return stretched.model_copy(update={"offset": offset, "markers": markers})

    def _fitted(
        self, key: str, name: str, before: tuple[ShapeParameters, ...]
    ) -> tuple[ShapeParameters, ...]:
        """Returns one fitted primitive for each of the template's.

        The primitives are fitted to clusters of the segment's points; the initial centres follow
        the template's primitives.
        """
        if not before:
            return ()
        points = self._points(key, name)
        centres = np.array([one.moments()[0] for one in before])
        spread_ratio = points.std(axis=0) / np.sqrt(np.diag(_mixture(before)))
        guess = points.mean(axis=0) + spread_ratio * (centres - centres.mean(axis=0))
        owners = clusters(points, points[scipy.spatial.cKDTree(points).query(guess)[1]])
        return tuple(
            type(one).fitted(points[owners == index], one) for index, one in enumerate(before)
        )

    def _points(self, key: str, name: str) -> Array:
        """Returns points inside a segment and inside fixed segments without primitives."""
        frame = self.layout.frames[name]
        return np.concatenate(
            [frame.local(self.parts[one].interior) for one in self._rigidly_attached(key, name)]
        )

    def _rigidly_attached(self, key: str, name: str) -> list[str]:
        """Returns a segment and the segments fixed to it that lack primitives of this list."""
        names = [name]
        for parent in names:
            names += [
                own
                for own, one in self.template.segments.items()
                if one.parent == parent
                and isinstance(one.joint or FixedJoint(), FixedJoint)
                and not self.template.shapes[key].get(own)
            ]
        return names

    def _offset(self, name: str) -> Array:
        """Returns the position of a segment's joint in its parent's frame, (3,) [m]."""
        parent = self.template.segments[name].parent
        assert parent is not None
        return self.layout.frames[parent].local(self.layout.frames[name].origin)


def _mixture(primitives: Sequence[ShapeParameters]) -> Array:
    """Returns the covariance (3, 3) [m^2] of a mixture of primitives with equal weights."""
    means, covariances = zip(*(one.moments() for one in primitives), strict=True)
    return np.asarray(np.cov(np.array(means).T, bias=True) + np.mean(covariances, axis=0))
