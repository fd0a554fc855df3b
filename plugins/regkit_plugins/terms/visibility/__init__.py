"""Occluded primitives get less weight."""

from regkit_plugins.terms.visibility.visibility import Visibility

__all__ = ["Visibility"]
