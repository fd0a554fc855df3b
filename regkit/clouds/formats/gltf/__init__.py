"""glTF 2.0 files: the surface of their scene.

- ``content``: the JSON, and the arrays that it describes.
- ``surface``: triangles and points, placed by their nodes.
"""

from regkit.clouds.formats.gltf.surface import read_gltf

__all__ = ["read_gltf"]
