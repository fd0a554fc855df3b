"""Preprocessors, which turn a frame into an observation.

Modules:
    octree: Octree leaves as Gaussians of their size.
    points: Points or voxels as Gaussians of equal variance.
"""
