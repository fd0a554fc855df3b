"""Extrinsics: the poses of several cameras from the body that moves before them.

- ``motions``: the body, tracked in each camera alone.
- ``alignment``: how two such motions lie to each other in space and time.
- ``paired``: the recording of all cameras at some poses.
- ``refinement``: the poses at which the energy of all cameras together is least.
- ``found``: the poses with their verdict; ``extrinsics``: the whole.
"""

from regkit.calibration.extrinsics.extrinsics import Extrinsics
from regkit.calibration.extrinsics.found import FoundCameras

__all__ = ["Extrinsics", "FoundCameras"]
