"""The base of a robot that stands still: one pose for all frames, and where the camera is from it.

- ``problem``: the base's pose and the joints of all frames together.
- ``found``: the base with its covariance and its verdict.
- ``fixed_base``: the whole, from a recording.
- ``template``: the template whose root is fixed at the base.
"""

from regkit.calibration.base.fixed_base import FixedBase
from regkit.calibration.base.found import FoundBase
from regkit.calibration.base.template import at_base

__all__ = ["FixedBase", "FoundBase", "at_base"]
