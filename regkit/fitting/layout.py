"""How a mesh is divided into the segments of a template, and turned into its rest pose."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from regkit.geometry.rigid import transformed
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array


@dataclass(frozen=True)
class SegmentFrame:
    """The frame of a segment in a mesh.

    Attributes:
        origin: (3,) the segment's joint, in the template's axes [m].
        rotation: (3, 3) turns the segment from the mesh's pose into the template's rest pose.
    """

    origin: Array
    rotation: Array

    def local(self, points: Array) -> Array:
        """Points (N, 3) or (3,) of the mesh, in the template's axes, in the segment's frame."""
        return np.asarray((points - self.origin) @ self.rotation.T)


@dataclass(frozen=True)
class Layout:
    """How a mesh is divided into the segments of a template.

    Attributes:
        T_template_mesh: (4, 4) from the mesh's axes to the template's [m].
        owners: The segment that each bone belongs to, by the bone's label.
        frames: The frame of each segment.
    """

    T_template_mesh: Array
    owners: Mapping[str, str]
    frames: Mapping[str, SegmentFrame]

    def neutral(self, mesh: SkinnedMesh) -> Array:
        """The mesh's vertices (V, 3) [m] in the template's rest pose, by linear blend skinning."""
        turn = self.T_template_mesh[:3, :3]
        frames = [self.frames[self.owners[label]] for label in mesh.labels]
        rotations = np.array([turn.T @ frame.rotation @ turn for frame in frames])
        posed = mesh.posed(mesh.rotated(rotations, mesh.rest[0, :3, 3]))
        return transformed(self.T_template_mesh, posed)
