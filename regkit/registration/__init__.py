"""Registration: coordinates, constraints, residuals and the problem with its one chain rule."""

from regkit.registration.coordinates import (
    COORDINATES,
    Coordinates,
    CoordinatesName,
    QuaternionCoordinates,
    TangentCoordinates,
)
from regkit.registration.problem import RegistrationProblem
from regkit.registration.residuals import Residuals, ResidualSimilarity
from regkit.registration.robust import Loss, Robust

__all__ = [
    "COORDINATES",
    "Coordinates",
    "CoordinatesName",
    "Loss",
    "QuaternionCoordinates",
    "RegistrationProblem",
    "ResidualSimilarity",
    "Residuals",
    "Robust",
    "TangentCoordinates",
]
