"""Preprocessors: from frames to the data of kernels."""

from __future__ import annotations

from abc import ABC, abstractmethod

from regkit.config.plugin import Plugin
from regkit.observation import Frame, Observation


class Preprocessor(Plugin, ABC):
    """A conversion of a frame's points to a sum of Gaussians."""

    group = "regkit.preprocessors"
    former_group = "regkit.observers"

    @abstractmethod
    def preprocess(self, frame: Frame) -> Observation:
        """Returns the data of a frame.

        Raises:
            DataError: If the frame has too few points, or points that are not finite.
        """
