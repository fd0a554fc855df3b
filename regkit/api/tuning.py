"""Tuning of a template's primitives to a method's own energy."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from regkit import __version__
from regkit.api.choices import Choice
from regkit.api.tables import Summary
from regkit.api.tuning_choices import TuningChoices, method_name
from regkit.body import BodyDescription
from regkit.body.modes import Modes
from regkit.body.template_file import check_replaceable, write_template
from regkit.geometry.camera import Camera
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interfaces import Method, Preprocessor, Template
from regkit.system.errors import ConfigError, RegkitError
from regkit.tuning.descent import Step
from regkit.tuning.trials import Comparison
from regkit.tuning.tuning import tuned

OPENING = """\
Made by `regkit tune` of the template {template}, for the method {method}. To use it:
template: {{kind: file, path: {file}}}
shape: {shape}

Lengths are in metres and angles in degrees."""

ADVICE = "try more samples, or let the camera see other bodies and proportions too"


@dataclass(frozen=True, repr=False)
class Tuned(Summary):
    """A template whose primitives are tuned to a method, and what that changes.

    Attributes:
        description: The template, which names method and figures in its ``sources``.
        template: Name of the template before tuning.
        method: Name of the method.
        key: Key of the tuned list in its ``shapes``: ``KIND`` or ``KIND/NAME``.
        steps: Costs of each step; the first is the start.
        comparisons: Errors before and after, in trials whose samples were not seen in tuning.
        failures: Why samples could not be rendered, in whose place there are others.
    """

    description: BodyDescription
    template: str
    method: str
    key: str
    steps: tuple[Step, ...]
    comparisons: tuple[Comparison, ...]
    failures: tuple[str, ...] = ()

    @property
    def worse(self) -> tuple[str, ...]:
        """Names of the trials in which tuning has done harm."""
        return tuple(one.name for one in self.comparisons if one.worse)

    @property
    def better(self) -> bool:
        """Whether tuning has helped in some trial, and done harm in none."""
        return not self.worse and any(one.better for one in self.comparisons)

    @property
    def shape(self) -> str:
        """The shape of a method that takes the tuned list, as YAML."""
        kind, _, name = self.key.partition("/")
        return f"{{kind: {kind}, tuned: {name}}}" if name else kind

    def rows(self) -> dict[str, str]:
        """Returns the rows of a table: the mean error before and after in each trial."""
        return {one.name: _change(one) for one in self.comparisons}

    def check(self) -> None:
        """Checks that the tuned template is better than the one before.

        Raises:
            RegkitError: If tuning has done harm in a trial, or helped in none.
        """
        if self.better:
            return
        if self.worse:
            harmed = [f"'{one.name}' ({_change(one)})" for one in self.comparisons if one.worse]
            told = f"tuning did harm in the trial {', '.join(harmed)}"
        else:
            told = f"tuning helped in no trial: {'; '.join(map(_named_change, self.comparisons))}"
        raise RegkitError(f"{told}. The template is not written; {ADVICE}")

    def write(self, path: str | Path) -> None:
        """Writes the template as YAML, with its mesh in a file beside it.

        Args:
            path: The file; an existing template is replaced.

        Raises:
            RegkitError: If the tuned template is not better, or the file exists and is no template,
                or it cannot be written.
        """
        out = Path(path)
        self.check()
        check_replaceable(out, place="path")
        mesh, modes = self.description.mesh, self.description.modes
        skin = None if mesh is None else SkinnedMesh.read(mesh)
        opening = OPENING.format(
            template=self.template, method=self.method, file=out.name, shape=self.shape
        )
        kept = None if modes is None else Modes.read(modes)
        write_template(out, self.description, skin, opening, modes=kept)


def tune(
    template: Choice[Template],
    method: Choice[Method] | None = None,
    *,
    name: str | None = None,
    bodies: Sequence[Choice[Template]] = (),
    proportions: float = 0.0,
    camera: Camera | str | Path | dict[str, Any] = "sr4000",
    noise: str | float | dict[str, Any] | None = None,
    preprocessor: Choice[Preprocessor] | None = None,
    primitives: int | None = None,
    samples: int = 240,
    seed: int = 0,
    jobs: int = 1,
    tell: Callable[[Step], None] = lambda _: None,
) -> Tuned:
    """Fits a template's primitives to a method's energy, so that a tracker ends at the true pose.

    Frames are rendered of the template's own surface, in random poses and views.

    Args:
        template: The template: ``"human"``, ``"hand"``, a file, or a result of ``load_template``.
        method: The method, as in ``register``; its shape lists its primitives in the template.
        name: Name of the tuned list, which the template holds as ``KIND/NAME`` beside the one
            before; by default that one is replaced.
        bodies: Other templates with the same joints that the camera sees too, at the same size.
        proportions: Spread of the lengths and girths of further bodies that it sees: 0.05 is 5 %.
        camera: A known camera such as ``"kinect_v1"``, a ``camera.json``, a mapping such as
            ``{"width": 320, "height": 240, "fx": 290}``, or a ``Camera``.
        noise: Noise of a known camera by its name, ``"none"``, a standard deviation [m], or its
            parts; by default that of a known camera, and none of any other.
        preprocessor: Preprocessing of frames; by default they are downsampled to about 900 points.
        primitives: Number of primitives to begin with, which fill the body; by default those that
            the template lists, or one for each of its capsules.
        samples: Number of training samples.
        seed: Seed of all samples.
        jobs: Number of processes; one is this process.
        tell: Called with each step.

    Returns:
        The tuned template, with the errors before and after.

    Raises:
        RegkitError: If an argument is invalid, the method cannot be tuned to, or samples cannot be
            rendered.
    """
    given = {
        "template": template,
        "method": method,
        "name": name,
        "bodies": bodies,
        "proportions": proportions,
        "camera": camera,
        "noise": noise,
        "preprocessor": preprocessor,
        "primitives": primitives,
        "samples": samples,
        "seed": seed,
    }
    chosen = TuningChoices.of(given, {(): "regkit.tune"})
    called = Method.default() if method is None else method
    return tuned_as(chosen, method_name(called), jobs, tell)


def tuned_as(chosen: TuningChoices, method: str, jobs: int, tell: Callable[[Step], None]) -> Tuned:
    """Tunes a template as chosen.

    Args:
        chosen: The choices.
        method: Name of the method.
        jobs: Number of processes.
        tell: Called with each step.

    Raises:
        RegkitError: If the method cannot be tuned to, or samples cannot be rendered.
    """
    if jobs < 1:
        raise ConfigError(f"must be at least 1; it is {jobs}", place="jobs")
    found = tuned(
        chosen.sets(),
        chosen.method,
        chosen.tracker(),
        name=chosen.name,
        primitives=chosen.primitives,
        samples=chosen.samples,
        jobs=jobs,
        tell=tell,
    )
    figures = "; ".join(map(_named_change, found.comparisons))
    source = (
        f"shapes: {found.key}: tuned by regkit {__version__} to the method {method}, with "
        f"{_bodies(chosen)} before the camera {chosen.seen_by}, {chosen.samples} samples, seed "
        f"{chosen.seed}; mean error before and after: {figures}"
    )
    description = found.description.model_copy(
        update={"sources": (*found.description.sources, source)}
    )
    return Tuned(
        description=description,
        template=chosen.template.name(),
        method=method,
        key=found.key,
        steps=found.steps,
        comparisons=found.comparisons,
        failures=found.failures,
    )


def _bodies(chosen: TuningChoices) -> str:
    """Returns what the camera sees in training."""
    names = ", ".join([chosen.template.name(), *(body.name() for body in chosen.bodies)])
    if not chosen.proportions:
        return names
    return f"{names} and proportions {100.0 * chosen.proportions:.3g} % off"


def _change(one: Comparison) -> str:
    """Returns the mean error before and after, and the change with its standard error."""
    before, after, change, doubt = (
        100.0 * value for value in (one.before.mean, one.after.mean, one.change, one.doubt)
    )
    return f"{before:.2f} to {after:.2f} cm, {change:+.2f} +- {doubt:.2f}"


def _named_change(one: Comparison) -> str:
    return f"{one.name} {_change(one)}"
