"""Bodies as displacements of a template's skin and joints, in the rest pose of that skin."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import numpy as np
import scipy

from regkit.body import BodyDescription
from regkit.fitting.layout import Layout
from regkit.fitting.skin import on_segments
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array, Indices


@dataclass(frozen=True)
class Reference:
    """A template's skin, and the mesh that it was made from.

    Attributes:
        template: The template.
        skin: Its skin.
        whole: The mesh with the template's segments as bones.
        kept: The vertices of the mesh that the skin has, (V,).
        layout: Divides a mesh of this topology into the segments.
    """

    template: BodyDescription
    skin: SkinnedMesh
    whole: SkinnedMesh
    kept: Indices
    layout: Callable[[SkinnedMesh], Layout]

    @classmethod
    def of(
        cls,
        template: BodyDescription,
        skin: SkinnedMesh,
        mesh: SkinnedMesh,
        layout: Callable[[SkinnedMesh], Layout],
    ) -> Reference:
        """Returns the reference of a template's skin and the mesh that it was made from."""
        whole = on_segments(mesh, layout(mesh), template)
        kept = scipy.spatial.cKDTree(whole.vertices).query(skin.vertices)[1]
        return cls(template, skin, whole, np.asarray(kept, dtype=np.intp), layout)

    def displacements(self, meshes: Iterable[SkinnedMesh]) -> Array:
        """Returns the displacements (N, V + S, 3) [m] of vertices and joints of other bodies.

        Each body is posed so that its segments are oriented as the skin's: what remains is shape.
        """
        own = np.concatenate([self.whole.vertices[self.kept], self.whole.rest[:, :3, 3]])
        return np.array([self._alike(mesh) - own for mesh in meshes])

    def _alike(self, mesh: SkinnedMesh) -> Array:
        """Returns vertices and joints (V + S, 3) [m] of a body in the skin's rest pose."""
        whole = on_segments(mesh, self.layout(mesh), self.template)
        part = replace(
            whole,
            vertices=whole.vertices[self.kept],
            indices=whole.indices[self.kept],
            weights=whole.weights[self.kept],
        )
        turns = self.whole.rest[:, :3, :3] @ whole.rest[:, :3, :3].swapaxes(1, 2)
        poses = part.rotated(turns, self.whole.rest[0, :3, 3])
        return np.concatenate([part.posed(poses), poses[:, :3, 3]])
