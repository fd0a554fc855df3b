"""The free-space term, which keeps the body out of free space."""

from regkit_plugins.terms.free_space.free_space import FreeSpace

__all__ = ["FreeSpace"]
