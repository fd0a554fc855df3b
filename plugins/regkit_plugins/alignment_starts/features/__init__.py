"""The start by matched features, verified by overlap and free space."""

from regkit_plugins.alignment_starts.features.features import Features

__all__ = ["Features"]
