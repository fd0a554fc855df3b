"""The division of a mesh into the segments of a template, and its rest pose."""

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
        origin: The segment's joint in the template's axes, (3,) [m].
        rotation: Rotation of the segment from the mesh's pose to the template's rest pose, (3, 3).
    """

    origin: Array
    rotation: Array

    def local(self, points: Array) -> Array:
        """Returns points (N, 3) or (3,) of the template's axes in the segment's frame [m]."""
        return np.asarray((points - self.origin) @ self.rotation.T)


@dataclass(frozen=True)
class Layout:
    """The division of a mesh into the segments of a template.

    Attributes:
        T_template_mesh: Transform from the mesh's axes to the template's, (4, 4) [m].
        owners: Segment of each bone, by the bone's label.
        frames: Frame of each segment.
    """

    T_template_mesh: Array
    owners: Mapping[str, str]
    frames: Mapping[str, SegmentFrame]

    def neutral(self, mesh: SkinnedMesh) -> Array:
        """Returns the vertices (V, 3) [m] in the template's rest pose, by linear blend skinning."""
        turn = self.T_template_mesh[:3, :3]
        frames = [self.frames[self.owners[label]] for label in mesh.labels]
        rotations = np.array([turn.T @ frame.rotation @ turn for frame in frames])
        posed = mesh.posed(mesh.rotated(rotations, mesh.rest[0, :3, 3]))
        return transformed(self.T_template_mesh, posed)
