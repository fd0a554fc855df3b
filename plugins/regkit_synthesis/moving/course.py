"""Courses: the places through which a whole body is carried."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated

import numpy as np
from pydantic import AfterValidator, Field

from regkit.config.model import Model
from regkit.config.quantities import Coordinate, Duration, Turn
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import from_vector, to_matrix
from regkit.system.arrays import Array
from regkit_synthesis.motion.mending import interpolated, smooth_step


class Waypoint(Model):
    """A place on a course at a time."""

    time: Duration = 0.0
    """Time [s]."""
    place: tuple[Coordinate, Coordinate, Coordinate] = (0.0, 0.0, 0.0)
    """Position of the body's own ground: to the right of the image, away from the camera and up,
    seen by a level camera [m]."""
    rotation_deg: tuple[Turn, Turn, Turn] = (0.0, 0.0, 0.0)
    """Rotation about these axes, as a rotation vector [deg]."""


def _increasing(points: tuple[Waypoint, ...]) -> tuple[Waypoint, ...]:
    times = [point.time for point in points]
    if any(later <= earlier for earlier, later in pairwise(times)):
        raise ValueError(f"the times of the course must increase; they are {times}")
    return points


Course = Annotated[tuple[Waypoint, ...], Field(min_length=1), AfterValidator(_increasing)]
"""Places in temporal order; the body rests in each, and in the first and last one outside."""


def carried(course: tuple[Waypoint, ...], time: float) -> Array:
    """Returns ``T_ground_own`` (4, 4) of a course at ``time`` [s]."""
    times = np.array([point.time for point in course])
    after = int(np.searchsorted(times, time, side="right"))
    begin, end = course[max(after - 1, 0)], course[min(after, len(course) - 1)]
    share = 0.0
    if end.time > begin.time:
        share = float(smooth_step(np.array((time - begin.time) / (end.time - begin.time))))
    turns = [from_vector(np.radians(point.rotation_deg)) for point in (begin, end)]
    places = [np.array(point.place) for point in (begin, end)]
    return rigid(
        to_matrix(interpolated(turns[0], turns[1], share)),
        places[0] + share * (places[1] - places[0]),
    )
