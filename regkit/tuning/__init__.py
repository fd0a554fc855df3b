"""Tuning: training samples, rendered of a template's own surface in random motion.

- ``surface``: what a camera sees of a body.
- ``motion``, ``pace``, ``overlap``: random motion within the joint limits, without intersection.
- ``views``: where the camera is.
- ``transfer``: poses of one body for another.
- ``samples``: all of it, from a seed and an index to frames with their true poses.
"""

from regkit.tuning.motion import Movement
from regkit.tuning.samples import Sample, Sampler
from regkit.tuning.surface import rendered_surface
from regkit.tuning.views import Views

__all__ = ["Movement", "Sample", "Sampler", "Views", "rendered_surface"]
