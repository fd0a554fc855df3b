"""glTF 2.0 files: their containers, data and surface.

- ``container``: the JSON of a .gltf file, or the chunks of a .glb file.
- ``uri``: data in the file or beside it.
- ``data``: the arrays that the JSON describes.
- ``triangles``: the triangles of a mesh's primitive.
- ``surface``: triangles and points, placed by their nodes.
"""

from regkit.clouds.formats.gltf.data import GltfData
from regkit.clouds.formats.gltf.surface import read_gltf
from regkit.clouds.formats.gltf.triangles import LINES, POINTS, triangles

__all__ = ["LINES", "POINTS", "GltfData", "read_gltf", "triangles"]
