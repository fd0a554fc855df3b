"""The method that registers a body first, and then its parts where they are seen."""

from regkit_plugins.methods.body_first.body_first import BodyFirst

__all__ = ["BodyFirst"]
