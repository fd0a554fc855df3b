"""The constant-velocity tracker, with recovery of lost bodies."""

from regkit_plugins.trackers.constant_velocity.constant_velocity import ConstantVelocity

__all__ = ["ConstantVelocity"]
