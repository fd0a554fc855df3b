"""PCL's point cloud format (PCD), of any field types.

Source: https://pointclouds.org/documentation/tutorials/pcd_file_format.html.

- ``header``: fields, layout and viewpoint.
- ``reading``: the points.
"""

from regkit.clouds.formats.pcd.reading import read_organised_pcd, read_pcd

__all__ = ["read_organised_pcd", "read_pcd"]
