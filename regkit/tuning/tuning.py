"""Tuning of a template's primitives to a method's own energy."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from regkit.body import BodyDescription, ShapeParameters
from regkit.body.shape_keys import list_key
from regkit.interfaces import ListedShapeModel, Method, Tracker
from regkit.system.errors import ConfigError
from regkit.system.progress import steps, working
from regkit.tuning.crew import crew
from regkit.tuning.descent import HELD_OUT, TRAINING, Descent, Step
from regkit.tuning.layout import divided, one_per_capsule
from regkit.tuning.sample_set import SampleSet
from regkit.tuning.sets import HELD, SampleSets
from regkit.tuning.trials import Comparison
from regkit.tuning.tunable import Tunable

PRIOR = 1e-4
"""Weight of the squared parameters, which keep near the primitives before tuning.

Chosen from two values on the trials of the average person with 41 Gaussians under ``best``.
"""


@dataclass(frozen=True)
class TunedList:
    """A template with a tuned list of primitives.

    Attributes:
        description: The template.
        key: Key of the tuned list in its ``shapes``.
        steps: The steps of the descent; the first is the start.
        comparisons: Trials of the primitives that the template had, and of the tuned ones.
        failures: Why samples could not be rendered, in whose place there are others.
    """

    description: BodyDescription
    key: str
    steps: tuple[Step, ...]
    comparisons: tuple[Comparison, ...]
    failures: tuple[str, ...] = ()


def tuned(
    sets: SampleSets,
    method: Method,
    tracker: Tracker,
    *,
    name: str | None = None,
    primitives: int | None = None,
    samples: int = 240,
    iterations: int = 12,
    prior: float = PRIOR,
    jobs: int = 1,
    tell: Callable[[Step], None] = lambda _: None,
) -> TunedList:
    """Tunes the primitives of a template to a method.

    Args:
        sets: The template, and what a camera sees of it.
        method: The method, whose shape model has its primitives in the template.
        tracker: What leads the method from frame to frame.
        name: Name of the tuned list, which the template holds as ``KIND/NAME``; by default the list
            that the method takes is replaced.
        primitives: Number of primitives to begin with, which fill the body: one for each of its
            capsules if there are as many, else as ``divided`` places them; by default those that
            the template lists, or one for each of its capsules.
        samples: Number of training samples.
        iterations: Maximum number of steps.
        prior: Weight of the squared parameters, which keep near the primitives before tuning.
        jobs: Number of processes.
        tell: Called with each step.

    Raises:
        ConfigError: If the method has no shape model whose primitives can be tuned, or no
            derivative.
        RegkitError: If too many samples in succession cannot be rendered.
    """
    tunable = _tunable(sets, method, tracker, primitives)
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
            failures = workers.render()
        with working("tuning"):
            descent = Descent(workers, sets.body.limb_radius, prior, iterations)
            found = descent.found(told)
        after = tunable.primitives(found)
        comparisons = []
        for trial in steps(trials, "comparing", len(trials)):
            (before, then), more = workers.tried(trial, [tunable.former, after])
            failures += more
            comparisons.append(Comparison.of(trial.name, before, then, sets.body.size))
    kind, _, old = tunable.key.partition("/")
    key = list_key(kind, (old or None) if name is None else name)
    listed: dict[str, tuple[ShapeParameters, ...]] = {}
    for segment, one in zip(after.segments.tolist(), after.parameters, strict=True):
        at = sets.body.skeleton.names[segment]
        listed[at] = (*listed.get(at, ()), one)
    return TunedList(
        _with_list(sets, key, listed), key, tuple(taken), tuple(comparisons), tuple(failures)
    )


def _tunable(sets: SampleSets, method: Method, tracker: Tracker, primitives: int | None) -> Tunable:
    """Returns what is tuned.

    Raises:
        ConfigError: If the method has no shape model whose primitives can be tuned.
    """
    shape = method.shape_model()
    if not isinstance(shape, ListedShapeModel) or shape.parameters is None:
        takes = "has no shape model"
        if shape is not None:
            takes = f"takes the shape '{shape.kind}', whose primitives no template lists"
        raise ConfigError(
            f"the method '{method.kind}' {takes}; tuning needs a shape with parameters, such as "
            "that of the default method"
        )
    body = sets.body
    key = list_key(shape.kind, shape.tuned)
    former = shape.listed(body)
    if primitives is not None or not former:
        made = shape.parameters
        by_name = (
            one_per_capsule(body, made)
            if primitives in (None, len(body.capsules))
            else divided(body, made, primitives, alike=True)
        )
        body = _with_list(sets, key, by_name).body(body.name, body.size)
    listed = body.shapes[key]
    if not any(one.freedoms() for one in listed.parameters):
        raise ConfigError(f"the primitives of the shape '{shape.kind}' have no free parameters")
    return Tunable(method, tracker, body, key, listed, former or listed)


def _with_list(
    sets: SampleSets, key: str, by_name: Mapping[str, tuple[ShapeParameters, ...]]
) -> BodyDescription:
    """Returns the template with a list of primitives."""
    description = sets.template.description()
    return description.model_copy(update={"shapes": {**description.shapes, key: dict(by_name)}})


def _check_derivative(tunable: Tunable, whole: SampleSet) -> None:
    """Checks with one sample, before all are rendered, that the method can be tuned to.

    Raises:
        ConfigError: If the method has no derivative.
    """
    sample = whole.sample(0, [])
    registrar = tunable.registrar(tunable.start())
    registrar.gradient(sample.observations[0], sample.starts[0])
