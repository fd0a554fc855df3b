"""The intersection term, which keeps the parts of a body apart."""

from regkit_plugins.terms.intersection.intersection import Intersection

__all__ = ["Intersection"]
