"""The ITOP dataset."""

from regkit_plugins.datasets.itop.itop import Itop

__all__ = ["Itop"]
