"""No two parts of a body are in the same place."""

from regkit_plugins.terms.intersection.intersection import Intersection

__all__ = ["Intersection"]
