"""A kernel's energy minimised over the pose."""

from regkit_plugins.methods.direct.direct import Direct

__all__ = ["Direct"]
