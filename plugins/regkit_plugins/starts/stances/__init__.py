"""The search among a few likely stances."""

from regkit_plugins.starts.stances.stances import Stances

__all__ = ["Stances"]
