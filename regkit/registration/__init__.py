"""Registration: coordinates, constraints, residuals and the problem with its one chain rule."""

from regkit.registration.charts import COORDINATES, CoordinatesName
from regkit.registration.coordinates import Coordinates
from regkit.registration.effective_points import effective_points, thinned
from regkit.registration.energy import FrameEnergy, SummedEnergy
from regkit.registration.lifted_curvature import lifted_curvature
from regkit.registration.plan import Plan
from regkit.registration.planned_energy import CompiledProblem, PlannedEnergy, PlannedJoints
from regkit.registration.posterior import PoseCurvature, marker_covariances
from regkit.registration.problem import RegistrationProblem
from regkit.registration.quaternions import QuaternionCoordinates
from regkit.registration.residuals import Residuals, ResidualSimilarity
from regkit.registration.robust import Loss, Robust
from regkit.registration.tangent import TangentCoordinates
from regkit.registration.views import ViewEnergy, ViewsEnergy

__all__ = [
    "COORDINATES",
    "CompiledProblem",
    "Coordinates",
    "CoordinatesName",
    "FrameEnergy",
    "Loss",
    "Plan",
    "PlannedEnergy",
    "PlannedJoints",
    "PoseCurvature",
    "QuaternionCoordinates",
    "RegistrationProblem",
    "ResidualSimilarity",
    "Residuals",
    "Robust",
    "SummedEnergy",
    "TangentCoordinates",
    "ViewEnergy",
    "ViewsEnergy",
    "effective_points",
    "lifted_curvature",
    "marker_covariances",
    "thinned",
]
