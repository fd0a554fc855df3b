"""Geometry without poses or data: rotations, rigid motions, cameras, capsules, skinned surfaces.

Modules:
    rotation: Unit quaternions, rotation vectors and rotation matrices, batched.
    rigid: Rigid motions as 4x4 matrices.
    bilinear: Quaternion products as matrix products with constant tables.
    camera: Pinhole cameras.
    capsules: Tapered capsules and their signed distance.
    skinned_mesh: Triangle meshes with linear blend skinning.
    surface: Skinned surfaces in segment frames, with or without triangles.

The package exports classes; import functions from ``rotation`` and ``rigid``.
"""

from regkit.geometry.camera import Camera
from regkit.geometry.capsules import AxisPoints, Capsules
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.geometry.surface import SkinnedSurface

__all__ = ["AxisPoints", "Camera", "Capsules", "SkinnedMesh", "SkinnedSurface"]
