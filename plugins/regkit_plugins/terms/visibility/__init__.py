"""The visibility term, which reduces the weights of occluded primitives."""

from regkit_plugins.terms.visibility.visibility import Visibility

__all__ = ["Visibility"]
