"""The non-rigid method: a smooth deformation after another method's pose."""

from regkit_plugins.methods.nonrigid.nonrigid import Nonrigid

__all__ = ["Nonrigid"]
