"""Clouds registered from coarse to fine."""

from regkit_plugins.methods.coarse_to_fine.coarse_to_fine import CoarseToFine

__all__ = ["CoarseToFine"]
