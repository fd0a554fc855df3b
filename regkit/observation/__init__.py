"""What is measured: frames, observations made of them, and the reference joints."""

from regkit.observation.frame import Frame
from regkit.observation.observation import Observation
from regkit.observation.truth import Truth

__all__ = ["Frame", "Observation", "Truth"]
