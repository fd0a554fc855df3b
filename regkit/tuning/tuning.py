"""Tuning of a template's primitives to a method's own energy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from regkit.body import Body, BodyDescription, ShapeParameters
from regkit.body.shape_keys import list_key
from regkit.interfaces import ListedShapeModel, Method, Tracker
from regkit.system.errors import ConfigError
from regkit.system.progress import steps, working
from regkit.tuning.crew import SampleSet, crew
from regkit.tuning.descent import HELD_OUT, TRAINING, Descent, Step
from regkit.tuning.sets import HELD, SampleSets
from regkit.tuning.trials import Comparison
from regkit.tuning.tunable import Tunable

PRIOR = 4e-4
"""Weight of the squared parameters, which keep near the primitives before tuning."""


@dataclass(frozen=True)
class Tuned:
    """A template with tuned primitives.

    Attributes:
        description: The template.
        key: Key of the tuned list in its ``shapes``.
        steps: The steps of the descent; the first is the start.
        comparisons: Trials of the primitives before and after.
    """

    description: BodyDescription
    key: str
    steps: tuple[Step, ...]
    comparisons: tuple[Comparison, ...]

    @property
    def worse(self) -> tuple[str, ...]:
        """Names of the trials in which tuning has done harm."""
        return tuple(one.name for one in self.comparisons if one.worse)

    @property
    def better(self) -> bool:
        """Whether tuning has helped in some trial, and done harm in none."""
        return not self.worse and any(one.better for one in self.comparisons)


def tuned(
    sets: SampleSets,
    method: Method,
    tracker: Tracker,
    *,
    name: str | None = None,
    samples: int = 240,
    iterations: int = 12,
    jobs: int = 1,
    tell: Callable[[Step], None] = lambda _: None,
) -> Tuned:
    """Tunes the primitives of a template to a method.

    Args:
        sets: The template, and what a camera sees of it.
        method: The method, whose shape model has its primitives in the template.
        tracker: What leads the method from frame to frame.
        name: Name of the tuned list, which the template holds as ``KIND/NAME``; by default the list
            that the method takes is replaced.
        samples: Number of training samples.
        iterations: Maximum number of steps.
        jobs: Number of processes.
        tell: Called with each step.

    Raises:
        ConfigError: If the method has no shape model whose primitives can be tuned, or no
            derivative.
        RegkitError: If samples cannot be rendered.
    """
    tunable = _tunable(sets.body, method, tracker)
    trials = sets.trials()
    taken: list[Step] = []

    def told(step: Step) -> None:
        taken.append(step)
        tell(step)

    kept = (
        SampleSet(TRAINING, sets.training(), samples),
        SampleSet(HELD_OUT, sets.held_out(), HELD),
    )
    with crew(tunable, kept, jobs) as workers:
        with working("rendering samples"):
            _check_derivative(tunable, kept[0])
            workers.render()
        with working("tuning"):
            descent = Descent(workers, sets.body.limb_radius, PRIOR, iterations)
            found = descent.found(told)
        after = tunable.primitives(found)
        comparisons = []
        for trial in steps(trials, "comparing", len(trials)):
            before, then = workers.tried(trial, [tunable.start(), found])
            comparisons.append(Comparison.of(trial.name, before, then, sets.body.size))
    kind, _, old = tunable.key.partition("/")
    key = list_key(kind, (old or None) if name is None else name)
    description = sets.template.description()
    listed: dict[str, tuple[ShapeParameters, ...]] = {}
    for segment, one in zip(after.segments.tolist(), after.parameters, strict=True):
        at = sets.body.skeleton.names[segment]
        listed[at] = (*listed.get(at, ()), one)
    shapes = {**description.shapes, key: listed}
    return Tuned(
        description.model_copy(update={"shapes": shapes}), key, tuple(taken), tuple(comparisons)
    )


def _tunable(body: Body, method: Method, tracker: Tracker) -> Tunable:
    """Returns what is tuned.

    Raises:
        ConfigError: If the method has no shape model whose primitives can be tuned.
    """
    shape = method.shape_model()
    if not isinstance(shape, ListedShapeModel):
        takes = "has no shape model"
        if shape is not None:
            takes = f"takes the shape '{shape.kind}', whose primitives no template lists"
        raise ConfigError(
            f"the method '{method.kind}' {takes}; tuning needs a shape with parameters, such as "
            "that of the default method"
        )
    listed = shape.listed(body)
    if listed is None or not len(listed):
        raise ConfigError(
            f"the template '{body.name}' lists no primitives of the shape '{shape.kind}'"
        )
    if not any(one.freedoms() for one in listed.parameters):
        raise ConfigError(f"the primitives of the shape '{shape.kind}' have no free parameters")
    return Tunable(method, tracker, body, list_key(shape.kind, shape.tuned), listed)


def _check_derivative(tunable: Tunable, whole: SampleSet) -> None:
    """Checks with one sample, before all are rendered, that the method can be tuned to.

    Raises:
        ConfigError: If the method has no derivative.
    """
    sample = whole.samplers[0].sample(0)
    registrar = tunable.registrar(tunable.start())
    registrar.gradient(sample.observations[0], sample.starts[0])
