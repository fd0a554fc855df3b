"""A tracked frame as it is drawn."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.api import Tracking
from regkit.system.arrays import Array
from regkit_plugins.shapes.gsog import GeneralizedSumOfGaussians

TRUNK, LEFT, RIGHT = (240, 190, 104), (86, 178, 170), (236, 128, 110)


@dataclass(frozen=True)
class Snapshot:
    """A tracked frame as it is drawn, in the depth camera's axes.

    Attributes:
        points: (N, 3) measured points [m].
        centres: (G, 3) centres of the Gaussians [m].
        covariances: (G, 3, 3) their covariances [m^2].
        colours: (G, 3) their colours.
        markers: Where each marker is (3,) [m], by name.
        ground: How far the ground is below the camera [m].
    """

    points: Array
    centres: Array
    covariances: Array
    colours: Array
    markers: dict[str, Array]
    ground: float

    @classmethod
    def of(cls, tracked: Tracking, index: int, points: Array, ground: float) -> Snapshot:
        """A frame of a track, with all points of its depth image."""
        gaussians = GeneralizedSumOfGaussians().bind(tracked.body)
        placed = gaussians.place(tracked.segments[index])
        spread = placed.axes * gaussians.scales[:, None, :]
        names = [tracked.body.skeleton.names[segment] for segment in gaussians.segments]
        colours = [
            LEFT if name.startswith("left") else RIGHT if name.startswith("right") else TRUNK
            for name in names
        ]
        markers = dict(zip(tracked.joint_names, tracked.markers[index], strict=True))
        covariances = spread @ spread.transpose(0, 2, 1)
        shades = np.array(colours, dtype=float)
        return cls(points, placed.centres, covariances, shades, markers, ground)
