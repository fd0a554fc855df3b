"""The clamp term, which limits the overlap that each data point contributes."""

from regkit_plugins.terms.clamp.clamp import Clamp

__all__ = ["Clamp"]
