"""The search among the template's own poses, seen from all sides."""

from regkit_plugins.starts.exemplars.exemplars import Exemplars

__all__ = ["Exemplars"]
