"""Preprocessors, which turn a frame into an observation.

- ``octree``: octree leaves as Gaussians of their size.
- ``points``: points or voxels as Gaussians of equal variance.
"""
