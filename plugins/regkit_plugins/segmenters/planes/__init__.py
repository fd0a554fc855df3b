"""Removal of floor and walls."""

from regkit_plugins.segmenters.planes.planes import Planes

__all__ = ["Planes"]
