"""The direct method: minimises the energy of a kernel and terms over the pose."""

from regkit_plugins.methods.direct.direct import Direct

__all__ = ["Direct"]
