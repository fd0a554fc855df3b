"""Removal of the static background."""

from regkit_plugins.segmenters.background.background import Background

__all__ = ["Background"]
