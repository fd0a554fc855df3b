"""Shape and poses of a template with shape modes, fitted to data with its skin."""

from regkit.calibration.skin.fit import SkinFit, fitted, skin_distances
from regkit.calibration.skin.measured import Measured
from regkit.calibration.skin.measured_views import MeasuredFrame, measured

__all__ = ["Measured", "MeasuredFrame", "SkinFit", "fitted", "measured", "skin_distances"]
