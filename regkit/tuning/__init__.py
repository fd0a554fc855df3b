"""Tuning: a template's primitives fitted to a method's own energy, on rendered samples.

- ``surface``, ``motion``, ``views``, ``samples``: frames of a body in random motion, with its true
  poses, from a seed and an index.
- ``sets``: the samples for training, for stopping early, and for trials.
- ``layout``: how many primitives stand for a body, and where.
- ``tunable``, ``ties``: the free parameters, of which those of both sides of a body are one.
- ``rollouts``, ``sensitivity``: where a tracker ends, and how that moves with the parameters.
- ``crew``, ``descent``: the search for better ones, by several processes.
- ``trials``: the errors before and after.
- ``tuning``: all of it.
"""

from regkit.tuning.layout import divided, one_per_capsule
from regkit.tuning.motion import Movement
from regkit.tuning.samples import Sample, Sampler
from regkit.tuning.sets import SampleSets
from regkit.tuning.surface import rendered_surface
from regkit.tuning.tuning import Tuned, tuned
from regkit.tuning.views import Views

__all__ = [
    "Movement",
    "Sample",
    "SampleSets",
    "Sampler",
    "Tuned",
    "Views",
    "divided",
    "one_per_capsule",
    "rendered_surface",
    "tuned",
]
