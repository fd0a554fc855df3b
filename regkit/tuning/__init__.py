"""Tuning: a template's primitives fitted to a method's own energy, on rendered samples.

``regkit.tune`` is the way in; the parts:

- ``samples``: frames of a body in random motion, with its true poses, from a seed and an index.
- ``sample_set``, ``sets``, ``bodies``: those for training, for stopping early, and for trials.
- ``layout``: how many primitives stand for a body, and where.
- ``tunable``, ``ties``: the free parameters, of which those of both sides of a body are one.
- ``rollouts``, ``sensitivity``: where a tracker ends, and how that moves with the parameters.
- ``crew``, ``workers``, ``descent``: the search for better ones, by several processes.
- ``trials``: the errors before and after.
- ``tuning``: all of it.
"""

from regkit.tuning.descent import Step
from regkit.tuning.layout import divided, one_per_capsule
from regkit.tuning.sample_set import SampleSet
from regkit.tuning.samples import Sample, Sampler, Views
from regkit.tuning.sets import SampleSets
from regkit.tuning.trials import Comparison, Errors
from regkit.tuning.tuning import TunedList, tuned

__all__ = [
    "Comparison",
    "Errors",
    "Sample",
    "SampleSet",
    "SampleSets",
    "Sampler",
    "Step",
    "TunedList",
    "Views",
    "divided",
    "one_per_capsule",
    "tuned",
]
