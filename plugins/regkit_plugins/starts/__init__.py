"""Starts, which find the pose and size in the first frame.

- ``exemplars``: a search among the template's own poses, seen from all sides.
- ``stances``: a search among a few likely stances, upright and facing a level camera.
- ``given``: a pose in the configuration.
"""
