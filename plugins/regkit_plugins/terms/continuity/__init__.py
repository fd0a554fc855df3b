"""The continuity term, which keeps the pose close to the prior."""

from regkit_plugins.terms.continuity.continuity import Continuity

__all__ = ["Continuity"]
