"""Preprocessors: from a frame to the data that a kernel compares with."""

from __future__ import annotations

from abc import ABC, abstractmethod

from regkit.config.plugin import Plugin
from regkit.observation import Frame, Observation


class Preprocessor(Plugin, ABC):
    """Makes a sum of Gaussians of a frame's points."""

    group = "regkit.preprocessors"
    former_group = "regkit.observers"

    @abstractmethod
    def preprocess(self, frame: Frame) -> Observation:
        """Returns the frame as data.

        Raises:
            DataError: If it holds too few points, or points that are not finite.
        """
