"""Training samples: frames of a template's own surface in random motion, with its true poses.

- ``surface``, ``holes``: what a camera sees of a body.
- ``motion``, ``pace``, ``overlap``: random motion within the joint limits, without intersection.
- ``views``: where the camera is.
- ``transfer``: poses of one body for another.
- ``sampler``: all of it, from a seed and an index to frames with their true poses.
"""

from regkit.tuning.samples.motion import Movement
from regkit.tuning.samples.sampler import Sample, Sampler
from regkit.tuning.samples.surface import rendered_surface
from regkit.tuning.samples.views import Views

__all__ = ["Movement", "Sample", "Sampler", "Views", "rendered_surface"]
