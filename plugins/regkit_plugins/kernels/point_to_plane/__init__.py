"""The point-to-plane kernel: distances of points to the surfels of a mesh."""

from regkit_plugins.kernels.point_to_plane.point_to_plane import PointToPlane

__all__ = ["PointToPlane"]
