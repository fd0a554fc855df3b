"""The proportions of the person or hand that a recording shows."""

from regkit.calibration.calibration import Calibration, Watcher
from regkit.calibration.subject import Subject

__all__ = ["Calibration", "Subject", "Watcher"]
