"""The motion-prior term, which weighs a pose by what the frames before tell of it."""

from regkit_plugins.terms.motion_prior.motion_prior import MotionPrior

__all__ = ["MotionPrior"]
