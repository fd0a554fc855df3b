"""Kernels, which compare the primitives of a body with an observation.

- ``correlation``: the overlap of Gaussians, the paper's similarity.
- ``likelihood``: the mixture likelihood of the data under Gaussians.
- ``local_likelihood``: the likelihood of each point under its nearest Gaussians.
- ``point_to_plane``, ``point_to_point``: distances to surfels or vertices (ICP).
- ``sphere_distance``: distances to capsules and spheres.
"""
