"""Geometry without poses or data: rotations, rigid motions, cameras, capsules, skinned surfaces.

- ``rotation``: unit quaternions, rotation vectors and rotation matrices, batched.
- ``rigid``: rigid motions as 4x4 matrices.
- ``bilinear``: quaternion products as matrix products with constant tables.
- ``principal_axes``: principal axes of points.
- ``camera``, ``intrinsics``: pinhole cameras, and their matrix.
- ``lens``, ``distortion``: cameras with lens distortion, and the rectification of their images.
- ``capsules``: tapered capsules and their signed distance.
- ``skinned_mesh``, ``mesh_file``: triangle meshes with linear blend skinning, and their files.
- ``surface``: skinned surfaces in segment frames, with or without triangles.

The package exports classes; import functions from ``rotation`` and ``rigid``.
"""

from regkit.geometry.camera import Camera
from regkit.geometry.capsules import AxisPoints, Capsules
from regkit.geometry.lens import Lens
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.geometry.surface import SkinnedSurface

__all__ = ["AxisPoints", "Camera", "Capsules", "Lens", "SkinnedMesh", "SkinnedSurface"]
