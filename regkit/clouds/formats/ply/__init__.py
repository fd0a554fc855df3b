"""Polygon file format (PLY).

Source: Greg Turk, The PLY polygon file format, 1994.

- ``header``: elements and their properties.
- ``values``: the values of text and binary files.
- ``reading``: vertices and faces.
"""

from regkit.clouds.formats.ply.reading import read_organised_ply, read_ply

__all__ = ["read_organised_ply", "read_ply"]
