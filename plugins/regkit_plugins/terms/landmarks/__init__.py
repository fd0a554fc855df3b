"""The landmarks term, which pulls the body's markers to measured landmarks."""

from regkit_plugins.terms.landmarks.landmarks import LandmarksTerm

__all__ = ["LandmarksTerm"]
