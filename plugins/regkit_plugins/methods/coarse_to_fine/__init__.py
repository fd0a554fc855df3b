"""The coarse-to-fine method for rigid clouds."""

from regkit_plugins.methods.coarse_to_fine.coarse_to_fine import CoarseToFine

__all__ = ["CoarseToFine"]
