"""Point clouds: reading, writing, voxel downsampling, normals, checks, and registration quality."""

from regkit.clouds.checks import check_shape, check_sizes
from regkit.clouds.neighbourhoods import normals, spacing
from regkit.clouds.organised import OrganisedCloud
from regkit.clouds.planarity import planar_share
from regkit.clouds.reading import read_cloud, read_measured, read_organised
from regkit.clouds.stray import surface_downsampled, without_stray
from regkit.clouds.voxels import voxel_downsampled, voxel_for
from regkit.clouds.writing import check_writable, write_cloud

__all__ = [
    "OrganisedCloud",
    "check_shape",
    "check_sizes",
    "check_writable",
    "normals",
    "planar_share",
    "read_cloud",
    "read_measured",
    "read_organised",
    "spacing",
    "surface_downsampled",
    "voxel_downsampled",
    "voxel_for",
    "without_stray",
    "write_cloud",
]
