"""Point clouds by themselves: files, voxels, neighbourhoods, and whether they can be aligned."""

from regkit.clouds.neighbourhoods import normals, spacing
from regkit.clouds.reading import read_cloud
from regkit.clouds.voxels import voxel_downsampled, voxel_for
from regkit.clouds.writing import check_writable, write_cloud

__all__ = [
    "check_writable",
    "normals",
    "read_cloud",
    "spacing",
    "voxel_downsampled",
    "voxel_for",
    "write_cloud",
]
