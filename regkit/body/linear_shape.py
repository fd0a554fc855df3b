"""The shape of a template as a linear function of coefficients: its modes, lengths and girths."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
import scipy

from regkit.body.description import BodyDescription
from regkit.body.groups import Groups
from regkit.body.modes import Modes
from regkit.geometry.rigid import rigid
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.geometry.surface import SkinnedSurface
from regkit.skeleton import Placement, Skeleton
from regkit.skeleton.compile import compiled
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError

USUAL_FACTOR = 0.02
"""Standard deviation of the factors by which people's lengths and girths differ from what the modes
can show."""

LARGEST_FACTOR = 0.25
"""Largest change of a length or a girth beside the modes, as a fraction of it."""


@dataclass(frozen=True)
class LinearShape:
    """A template's skin and joints as a linear function of P coefficients.

    The coefficients are those of the modes, then the changes of the groups' lengths and girths as
    fractions; with all of them zero, the shape is the template's own. Linear blend skinning is
    linear in the vertices, and so is the stretch of bones, so that nothing is approximated.

    Attributes:
        template: The template.
        mesh: Its skin, whose bones are the S segments in the skeleton's order.
        names: Names of the coefficients, (P,).
        modes: Number K of them that are modes.
        joints: Displacement of the segments' origins in the skin's rest pose, (P, S, 3) [m].
        vertices: Displacement of the vertices in the skin's rest pose, (P, V, 3) [m].
        mean: Mean of the coefficients, (P,).
        information: Inverse of their covariance, (P, P).
        bounds: Smallest and largest value of each, (P, 2).
    """

    template: BodyDescription
    mesh: SkinnedMesh
    names: tuple[str, ...]
    modes: int
    joints: Array
    vertices: Array
    mean: Array
    information: Array
    bounds: Array

    @classmethod
    def of(cls, template: BodyDescription) -> LinearShape:
        """Returns the shape of a template with modes.

        Raises:
            ConfigError: If the template has no modes.
            DataError: If its mesh or its modes cannot be read, or do not belong together.
        """
        if template.mesh is None or template.modes is None:
            raise ConfigError(f"the template '{template.title}' has no shape modes")
        order = compiled(template).names
        mesh = _in_order(SkinnedMesh.read(template.mesh), order, template.mesh)
        modes = Modes.read(template.modes)
        _check(modes, order, len(mesh.vertices), template.modes)
        groups = Groups.of(template)
        lengths, girths = _stretches(mesh, groups)
        rows = [modes.labels.index(label) for label in order]
        more = 2 * len(groups.names)
        own = [f"{name} {what}" for what in ("length", "girth") for name in groups.names]
        return cls(
            template=template,
            mesh=mesh,
            names=(*modes.names, *own),
            modes=len(modes.names),
            joints=np.concatenate([modes.joints[:, rows], lengths[0], girths[0]]),
            vertices=np.concatenate([modes.vertices, lengths[1], girths[1]]),
            mean=np.concatenate([modes.mean, np.zeros(more)]),
            information=scipy.linalg.block_diag(
                np.linalg.inv(modes.covariance), USUAL_FACTOR**-2.0 * np.eye(more)
            ),
            bounds=np.concatenate(
                [modes.bounds, np.tile([-LARGEST_FACTOR, LARGEST_FACTOR], (more, 1))]
            ),
        )

    def __len__(self) -> int:
        """Number P of coefficients."""
        return len(self.names)

    def skin(self, x: Array) -> SkinnedMesh:
        """Returns the skin with the coefficients x (P,), in its rest pose."""
        origins = self.mesh.rest[:, :3, 3] + np.tensordot(x, self.joints, 1)
        return replace(
            self.mesh,
            vertices=self.mesh.vertices + np.tensordot(x, self.vertices, 1),
            rest=rigid(self.mesh.rest[:, :3, :3], origins),
        )

    def surface(self, x: Array) -> SkinnedSurface:
        """Returns the skin with the coefficients x (P,) in the segments' frames, no normals."""
        own = self.own
        return replace(own, points=own.points + np.tensordot(x, self.points, 1), normals=None)

    def skeleton(self, x: Array) -> Skeleton:
        """Returns the skeleton with the coefficients x (P,)."""
        links = self._bones.link_offsets.copy()
        links[self._joint_links, :3, 3] += np.tensordot(x, self.offsets, 1)
        return replace(self._bones, link_offsets=links)

    @cached_property
    def own(self) -> SkinnedSurface:
        """The template's own skin in the segments' frames."""
        return SkinnedSurface.of(self.mesh)

    @cached_property
    def points(self) -> Array:
        """Displacement of each vertex in the frames of its segments, (P, V, A, 3) [m]."""
        turns = self.mesh.rest[self.mesh.indices, :3, :3]
        moved = self.vertices[:, :, None] - self.joints[:, self.mesh.indices]
        return np.asarray(np.einsum("vaji,pvaj->pvai", turns, moved))

    @cached_property
    def offsets(self) -> Array:
        """Displacement of each segment's origin in its parent's frame, (P, S, 3) [m].

        The root's is zero.
        """
        parents = self._bones.parents
        moved = self.joints - self.joints[:, parents]
        turns = self.mesh.rest[parents, :3, :3]
        offsets = np.asarray(np.einsum("sji,psj->psi", turns, moved))
        offsets[:, parents < 0] = 0.0
        return offsets

    def energy(self, x: Array) -> float:
        """Returns minus the logarithm of the prior's density at x (P,), up to a constant."""
        away = x - self.mean
        return 0.5 * float(away @ self.information @ away)

    def size(self, x: Array) -> float:
        """Returns the size of a body with the coefficients x (P,) [m], by its extent along y."""
        heights = self._heights(np.stack([np.zeros(len(self)), x]))
        own, shaped = np.ptp(heights, axis=1)
        return float(self.template.size.value * shaped / own)

    def at_size(self, size: float) -> Array:
        """Returns the most probable coefficients (P,) of a size [m], within the bounds."""
        heights = self._heights(np.concatenate([[self.mean], self.mean + np.eye(len(self))]))
        top, bottom = heights[0].argmax(), heights[0].argmin()
        extents = heights[:, top] - heights[:, bottom]
        slopes = extents[1:] - extents[0]
        wanted = extents[0] * size / self.size(self.mean)
        away = np.linalg.solve(self.information, slopes)
        x = self.mean + away * (wanted - extents[0]) / (slopes @ away)
        return np.asarray(np.clip(x, *self.bounds.T))

    def _heights(self, several: Array) -> Array:
        """Returns the heights of the vertices in the template's rest pose, (X, V) [m]."""
        heights = []
        for x in several:
            bones = self.skeleton(x)
            rest = Placement.of(bones, bones.rest())
            heights.append(self.surface(x).place(rest.transforms)[:, 1])
        return np.array(heights)

    @cached_property
    def _bones(self) -> Skeleton:
        return compiled(self.template)

    @cached_property
    def _joint_links(self) -> list[int]:
        """The link of each segment that its parent carries: the first one of its joint."""
        bones = self._bones
        owned = set(bones.segment_links.tolist())
        links = []
        for link in bones.segment_links.tolist():
            while (parent := int(bones.link_parents[link])) >= 0 and parent not in owned:
                link = parent
            links.append(link)
        return links


def _in_order(mesh: SkinnedMesh, segments: tuple[str, ...], path: Path) -> SkinnedMesh:
    """Returns a mesh with the segments as its bones, in their order.

    Raises:
        DataError: If the mesh has other bones.
    """
    if set(mesh.labels) != set(segments):
        raise DataError(
            f"the bones of a mesh with shape modes must be the template's segments, "
            f"{', '.join(segments)}; they are {', '.join(mesh.labels)}",
            place=str(path),
        )
    order = np.array([mesh.labels.index(name) for name in segments])
    inverse = np.argsort(order)
    parents = np.where(mesh.parents < 0, -1, inverse[mesh.parents])
    return replace(
        mesh,
        labels=segments,
        parents=parents[order],
        rest=mesh.rest[order],
        indices=inverse[mesh.indices],
    )


def _check(modes: Modes, segments: tuple[str, ...], vertices: int, path: Path) -> None:
    """Checks that modes are those of a template.

    Raises:
        DataError: If they have another number of vertices, or lack a segment.
    """
    if modes.vertices.shape[1] != vertices:
        raise DataError(
            f"the modes move {modes.vertices.shape[1]} vertices, and the template's mesh has "
            f"{vertices}",
            place=str(path),
        )
    lacking = [name for name in segments if name not in modes.labels]
    if lacking:
        raise DataError(
            f"the modes do not say how the joint of '{lacking[0]}' moves (labels: "
            f"{', '.join(modes.labels)})",
            place=str(path),
        )


def _stretches(
    mesh: SkinnedMesh, groups: Groups
) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
    """Returns what lengths and girths twice as large add to origins (G, S, 3) and vertices."""
    found: tuple[list[list[Array]], ...] = ([[], []], [[], []])
    along = groups.bones[:, :, None] * groups.bones[:, None, :]
    for group in range(len(groups.names)):
        own = (groups.of_segments == group)[:, None, None]
        for (joints, vertices), matrix in zip(found, (along, np.eye(3) - along), strict=True):
            stretched = mesh.stretched(np.eye(3) + own * matrix)
            joints.append(stretched.rest[:, :3, 3] - mesh.rest[:, :3, 3])
            vertices.append(stretched.vertices - mesh.vertices)
    (first, second), (third, fourth) = found
    return (np.array(first), np.array(second)), (np.array(third), np.array(fourth))
