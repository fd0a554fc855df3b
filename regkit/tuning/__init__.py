"""Tuning: training samples, rendered of a template's own surface in random motion.

- ``surface``: what a camera sees of a body.
- ``motion``, ``pace``, ``overlap``: random motion within the joint limits, without intersection.
- ``views``: where the camera is.
- ``transfer``: poses of one body for another.
- ``layout``: how many primitives stand for a body, and where.
- ``segment_clusters``, ``clusters``: its points, divided among the primitives.
- ``samples``: all of it, from a seed and an index to frames with their true poses.
"""

from regkit.tuning.layout import divided, one_per_capsule
from regkit.tuning.motion import Movement
from regkit.tuning.samples import Sample, Sampler
from regkit.tuning.surface import rendered_surface
from regkit.tuning.views import Views

__all__ = [
    "Movement",
    "Sample",
    "Sampler",
    "Views",
    "divided",
    "one_per_capsule",
    "rendered_surface",
]
