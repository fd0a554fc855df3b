"""Methods of other libraries that deform a body after another method posed it."""

from regkit_plugins.methods.deformable.biocpd import BioCPDDeformable
from regkit_plugins.methods.deformable.pycpd import PyCPD
from regkit_plugins.methods.deformable.rustcpd import RustCPD
from regkit_plugins.methods.deformable.trimesh_nricp import TrimeshNRICP

__all__ = ["BioCPDDeformable", "PyCPD", "RustCPD", "TrimeshNRICP"]
