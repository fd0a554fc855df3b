"""File formats of clouds and meshes.

Every reader here is Python or NumPy, which cannot crash the process, and holds what it read against
what the file announced.

- ``text``: rows of numbers, with or without a header.
- ``pcd``, ``lzf``: PCL's format, and its compression.
- ``ply``, ``obj``, ``off``, ``stl``, ``gltf``: points and meshes.
- ``polygons``, ``mesh``: polygons cut into triangles, and points sampled on them.
"""
