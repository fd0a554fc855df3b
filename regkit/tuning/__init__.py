"""Tuning: primitives fitted to a method's own energy, on samples of a template's own surface.

``regkit.tune`` is the way in; the parts:

- ``surface``: what a camera sees of a body.
- ``motion``, ``pace``, ``overlap``: random motion within the joint limits, without intersection.
- ``views``: where the camera is.
- ``transfer``: poses of one body for another.
- ``samples``: all of it, from a seed and an index to frames with their true poses.
- ``tunable``, ``ties``: the independent parameters of a body's primitives.
- ``sensitivity``, ``rollouts``: where a tracker ends, and how that moves with them.
- ``descent``, ``crew``, ``workers``: the search for the parameters, by several processes.
- ``bodies``, ``sets``, ``trials``: what is trained with, and the errors before and after.
"""

from regkit.tuning.crew import SampleSet
from regkit.tuning.descent import Step
from regkit.tuning.motion import Movement
from regkit.tuning.samples import Sample, Sampler
from regkit.tuning.sets import SampleSets
from regkit.tuning.surface import rendered_surface
from regkit.tuning.trials import Comparison, Errors
from regkit.tuning.views import Views

__all__ = [
    "Comparison",
    "Errors",
    "Movement",
    "Sample",
    "SampleSet",
    "SampleSets",
    "Sampler",
    "Step",
    "Views",
    "rendered_surface",
]
