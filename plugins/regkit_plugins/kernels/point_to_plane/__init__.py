"""The distance of points to a mesh."""

from regkit_plugins.kernels.point_to_plane.point_to_plane import PointToPlane

__all__ = ["PointToPlane"]
