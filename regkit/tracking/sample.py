"""A sample of a recording's frames, evenly spread, in memory that does not grow."""

from __future__ import annotations

import numpy as np

from regkit.geometry.camera import Camera
from regkit.observation import Observation, PlacedCamera
from regkit.system.arrays import Array, Singles

MOST_FRAMES = 60
"""Maximum number of frames in a sample."""

MOST_POINTS = 1500
"""Maximum number of points of each."""


class FrameSample:
    """The points of frames that are spread evenly over a recording of any length.

    Every frame is kept until the sample is full; then every second one is dropped, and from there
    on only every second one is kept, and so on.

    Attributes:
        points: Points of each kept frame by its number, (N, 3) [m].
        camera: The camera of the first frame that has one.
        cameras: Each of several cameras by its name, as it was first seen.
    """

    def __init__(self) -> None:
        self.points: dict[int, Singles] = {}
        self.camera: Camera | None = None
        self.cameras: dict[str, PlacedCamera] = {}
        self._stride = 1

    def add(self, number: int, observation: Observation) -> None:
        """Takes the data of a frame, if its turn has come; frames come in ascending order."""
        self.camera = self.camera or observation.camera
        for placed in PlacedCamera.of_views(observation.views):
            self.cameras.setdefault(placed.name, placed)
        while len(self.points) >= MOST_FRAMES and number % self._stride == 0:
            self._stride *= 2
            self.points = {at: one for at, one in self.points.items() if at % self._stride == 0}
        if number % self._stride == 0:
            self.points[number] = thinned(observation.points)


def thinned(points: Array, most: int = MOST_POINTS) -> Singles:
    """Returns at most ``most`` of points (N, 3), evenly chosen, in single precision."""
    return points[:: max(1, -(-len(points) // most))].astype(np.float32)
