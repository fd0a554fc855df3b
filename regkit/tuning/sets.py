"""The sets of samples: for training, for stopping early, and for trials."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from regkit.body import Body
from regkit.interfaces import Preprocessor, Template
from regkit.observation import Frame
from regkit.sensors import CameraChoice
from regkit.sensors.noise import NoiseChoice
from regkit.system.errors import ConfigError
from regkit.tuning.bodies import other_body
from regkit.tuning.sample_set import SampleSet
from regkit.tuning.samples import Sampler
from regkit.tuning.samples.views import Views

HELD = 100
"""Number of held-out samples that stop the descent."""

TRIED = 60
"""Number of samples of a trial."""

LONG = 24
"""Number of frames of a sample of the trial of motion."""

PROPORTIONS = 6
"""Number of bodies of other proportions in a set."""

SPREAD = 0.05
"""Spread of the proportions in the trial, if there is none in training."""

ALL_ROUND = Views(frontal=0.0, elevation=(float(np.radians(-30.0)), float(np.radians(60.0))))
"""Views from anywhere around a body, and from above."""

FEWEST = 30
"""Number of pixels of the body from which on a preprocessor can be chosen."""

_TRAINING, _HELD_OUT, _TRIALS = 0, 1, 2
"""Parts of the seed, so that no set has a sample of another."""


@dataclass(frozen=True)
class SampleSets:
    """What a camera sees while a template is tuned, and when it is tried.

    Attributes:
        template: The template.
        choice: The preprocessor of frames, or a function that chooses one for a frame.
        others: Bodies of other templates, by their names, that a camera sees in training; they are
            scaled to the template's size.
        spread: Standard deviation of the logarithms of lengths and girths of further bodies that a
            camera sees in training; 0 for none.
        camera: The camera.
        noise: Its noise; by default that of a known camera, and none of any other.
        frames: Number of frames of a sample.
        seed: Seed of all samples.
    """

    template: Template
    choice: Preprocessor | Callable[[Frame], Preprocessor]
    others: Mapping[str, Template] = field(default_factory=dict)
    spread: float = 0.0
    camera: CameraChoice = "sr4000"
    noise: NoiseChoice | None = None
    frames: int = 5
    seed: int = 0

    @cached_property
    def body(self) -> Body:
        """The template's body, at the size for which its lengths hold."""
        description = self.template.description()
        return description.body(self.template.name(), description.size.value)

    @cached_property
    def preprocessor(self) -> Preprocessor:
        """The preprocessor; one to choose is chosen for the first image of the body."""
        if isinstance(self.choice, Preprocessor):
            return self.choice
        frame = Sampler(self.body, None, None, self.camera, self.noise).frame(0)
        if len(frame.points) < FEWEST:
            raise ConfigError(
                f"the first image shows the body in {len(frame.points)} pixels, too few to choose "
                "a preprocessor; take a camera with more pixels, or less noise"
            )
        return self.choice(frame)

    def training(self) -> tuple[Sampler, ...]:
        """Returns the sources of the training samples."""
        return self._samplers(self._seen(_TRAINING), _TRAINING)

    def held_out(self) -> tuple[Sampler, ...]:
        """Returns the sources of the samples that stop the descent: other bodies, other motion."""
        return self._samplers(self._seen(_HELD_OUT), _HELD_OUT)

    def trials(self) -> list[SampleSet]:
        """Returns the trials, none of whose samples is seen in tuning."""
        own = (self.body,)
        spread = self.spread or SPREAD
        strange = self._proportioned(spread, _TRIALS)
        sets: list[tuple[str, Sequence[Body], int, dict[str, Any]]] = [
            ("frames", own, TRIED, {"frames": 2}),
            ("motion", own, TRIED // 2, {"frames": LONG}),
            ("all round", own, TRIED, {"views": ALL_ROUND}),
            (f"proportions {100.0 * spread:.3g} % off", strange, TRIED, {}),
        ]
        for name, template in self.others.items():
            sets.append((name, (self._scaled(template),), TRIED, {}))
        return [
            SampleSet(name, self._samplers(bodies, _TRIALS + at, **options), count)
            for at, (name, bodies, count, options) in enumerate(sets)
        ]

    def _seen(self, part: int) -> tuple[Body, ...]:
        """Returns the bodies that a camera sees: the template's as often as all others together."""
        strange = self._proportioned(self.spread, part) if self.spread else ()
        others = (*map(self._scaled, self.others.values()), *strange)
        return tuple(body for other in others for body in (self.body, other)) or (self.body,)

    def _scaled(self, template: Template) -> Body:
        return template.description().body(template.name(), self.body.size)

    def _proportioned(self, spread: float, part: int) -> tuple[Body, ...]:
        """Returns bodies of other proportions."""
        description, body = self.template.description(), self.body
        random = np.random.default_rng([self.seed, part, PROPORTIONS])
        return tuple(
            other_body(description, body.name, body.size, spread, random)
            for _ in range(PROPORTIONS)
        )

    def _samplers(self, rendered: Sequence[Body], part: int, **options: Any) -> tuple[Sampler, ...]:
        seeds = np.random.SeedSequence([self.seed, part]).generate_state(len(rendered))
        return tuple(
            Sampler(
                body=self.body,
                preprocessor=self.preprocessor,
                rendered=None if body is self.body else body,
                camera=self.camera,
                noise=self.noise,
                seed=int(seed),
                **{"frames": self.frames, **options},
            )
            for body, seed in zip(rendered, seeds, strict=True)
        )
