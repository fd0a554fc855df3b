"""Organised clouds: points in rows and columns, as the pixels of an image."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from regkit.system.arrays import Array


@dataclass(frozen=True)
class OrganisedCloud:
    """A cloud in rows and columns.

    Attributes:
        points: The points, (H, W, 3) [m]; those that are not finite are missing measurements.
        T_cloud_sensor: Pose of the sensor in the cloud's frame, (4, 4).
    """

    points: Array
    T_cloud_sensor: Array = field(default_factory=lambda: np.eye(4))
