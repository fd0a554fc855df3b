"""Shape and poses of a template with shape modes, fitted to data with its skin."""

from regkit.calibration.skin.fit import SkinFit, fitted, skin_distances
from regkit.calibration.skin.measured import Measured

__all__ = ["Measured", "SkinFit", "fitted", "skin_distances"]
