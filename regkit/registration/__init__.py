"""Registration: coordinates, constraints, residuals and the problem with its one chain rule."""

from regkit.registration.charts import COORDINATES, CoordinatesName
from regkit.registration.coordinates import Coordinates
from regkit.registration.problem import RegistrationProblem
from regkit.registration.quaternions import QuaternionCoordinates
from regkit.registration.residuals import Residuals, ResidualSimilarity
from regkit.registration.robust import Loss, Robust
from regkit.registration.tangent import TangentCoordinates

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
