"""Prediction by constant velocity, with recovery."""

from regkit_plugins.trackers.constant_velocity.constant_velocity import ConstantVelocity

__all__ = ["ConstantVelocity"]
