"""Point clouds: reading, writing, voxel downsampling, normals, checks, and registration quality."""

from regkit.clouds.checks import check_shape, check_sizes
from regkit.clouds.neighbourhoods import normals, spacing
from regkit.clouds.planarity import planar_share
from regkit.clouds.reading import read_cloud, read_measured
from regkit.clouds.voxels import voxel_downsampled, voxel_for
from regkit.clouds.writing import check_writable, write_cloud

__all__ = [
    "check_shape",
    "check_sizes",
    "check_writable",
    "normals",
    "planar_share",
    "read_cloud",
    "read_measured",
    "spacing",
    "voxel_downsampled",
    "voxel_for",
    "write_cloud",
]
