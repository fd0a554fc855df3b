"""Calibration: the proportions and shape of a person or hand, estimated from a recording."""

from regkit.calibration.calibration import Calibration
from regkit.calibration.marker_set import MarkerSet
from regkit.calibration.marker_subject import MarkerSubject
from regkit.calibration.shape import Shape
from regkit.calibration.subject import Subject

__all__ = ["Calibration", "MarkerSet", "MarkerSubject", "Shape", "Subject"]
