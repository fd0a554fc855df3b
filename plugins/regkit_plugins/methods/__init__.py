"""Methods, which register a body to one frame.

- ``direct``: minimises the energy of a kernel and terms over the pose.
- ``coarse_to_fine``: registers rigid clouds at increasing resolution.
- ``open3d_icp``, ``small_gicp``, ``probreg``, ``biocpd``: rigid registration by other libraries.
"""
