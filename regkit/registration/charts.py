"""The coordinates available to a method."""

from __future__ import annotations

from typing import Literal

from regkit.registration.coordinates import Coordinates
from regkit.registration.quaternions import QuaternionCoordinates
from regkit.registration.tangent import TangentCoordinates

CoordinatesName = Literal["tangent", "quaternion"]

COORDINATES: dict[CoordinatesName, type[Coordinates]] = {
    "tangent": TangentCoordinates,
    "quaternion": QuaternionCoordinates,
}
