"""The sphere-distance kernel: distances of points to capsules and spheres."""

from regkit_plugins.kernels.sphere_distance.sphere_distance import SphereDistance

__all__ = ["SphereDistance"]
