"""Choice of a connected piece of the scene."""

from regkit_plugins.segmenters.pieces.pieces import Pieces

__all__ = ["Pieces"]
