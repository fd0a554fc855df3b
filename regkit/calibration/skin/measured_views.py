"""What several cameras measured of one frame, and its distances to a skin."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from regkit.calibration.skin.measured import Measured
from regkit.calibration.skin.skin_distances import SkinDistances
from regkit.calibration.skin.skin_points import SkinPoints
from regkit.geometry.rigid import transformed
from regkit.observation import Observation
from regkit.observation.view import View
from regkit.system.arrays import Array


class MeasuredFrame(Protocol):
    """The data of one frame."""

    def distances(
        self, skin: SkinPoints, vertices: Array, size: float
    ) -> tuple[SkinDistances, SkinDistances, SkinDistances]:
        """Returns the distances of ``Measured.distances``."""


@dataclass(frozen=True)
class MeasuredViews(MeasuredFrame):
    """The data of one frame by several cameras.

    Attributes:
        views: What each camera measured, and its pose.
    """

    views: Sequence[tuple[View[Observation], Measured]]

    def distances(
        self, skin: SkinPoints, vertices: Array, size: float
    ) -> tuple[SkinDistances, SkinDistances, SkinDistances]:
        """Returns the distances of all views; the arguments are in the world."""
        found = []
        for view, measured in self.views:
            sides = measured.distances(skin, transformed(view.to_camera, vertices), size)
            turn = view.T_world_camera[:3, :3].T
            found.append([replace(side, directions=side.directions @ turn) for side in sides])
        to_skin, to_data, outline = (
            SkinDistances.joined(*several) for several in zip(*found, strict=True)
        )
        return to_skin, to_data, outline


def measured(observation: Observation, share: float = 1.0) -> MeasuredFrame:
    """Returns the data of an observation by one camera, by several, or without one.

    Args:
        observation: The observation.
        share: The part of all compared points that are this frame's.
    """
    if not observation.views:
        return Measured.of(observation, share)
    own = share / len(observation.views)
    return MeasuredViews([(view, Measured.of(view.data, own)) for view in observation.views])
