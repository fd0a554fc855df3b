"""The filter tracker: each frame is weighed against what the frames before it tell."""

from regkit_plugins.trackers.filter.filter import Filter

__all__ = ["Filter"]
