"""Gaussians and points: pairs, moments, overlap and visible surfaces.

- ``pairs``: densities, moments and derivatives over all pairs of Gaussians and points.
- ``overlap``: the overlap of model and data Gaussians, the paper's similarity (eq. 8).
- ``seen``: Gaussians as volumes, or as surfaces visible to a camera.
- ``similarity``: the base class of kernels that compare Gaussians.
- ``cloud_shape``: the base class of shape models with Gaussians at surface points.
- ``compiled``: visible surfaces and moments in compiled loops.
"""
