"""Cases of the starts' benchmark: a template, frames of its body, and the truth."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, TypeVar

import numpy as np
from _starts_bodies import Subject
from _starts_shots import Shots

from regkit.interfaces import Preprocessor
from regkit.observation import Observation
from regkit.system.arrays import Indices


@dataclass(frozen=True)
class Case(ABC):
    """A body to find.

    Attributes:
        subject: The body with its template.
    """

    subject: Subject

    preprocessor: ClassVar[dict[str, Any]] = {"kind": "points", "voxel": 0.03, "sigma": 0.01}
    """Preprocessor of the frames; by default that of people in the accuracy benchmarks."""

    @property
    @abstractmethod
    def name(self) -> str:
        """Returns everything that the frames depend on, in words."""

    @abstractmethod
    def shots(self) -> Shots:
        """Returns the frames, made on first use; the start is sought in the first one."""

    def judged_joints(self) -> Indices:
        """Returns the joints whose errors count; by default all."""
        return np.arange(len(self.shots().joints))

    def observations(self) -> list[Observation]:
        """Returns the preprocessed frames."""
        data = dict(self.preprocessor)
        prepares = Preprocessor.parse(data, place="benchmark", field="preprocessor")
        return [prepares.preprocess(frame) for frame in self.shots().frames()]

    def random(self, *more: int) -> np.random.Generator:
        """Returns the case's own random generator, or one of several."""
        return np.random.default_rng([*more, *self.name.encode()])


AnyCase = TypeVar("AnyCase", bound=Case)


def subset(every: Sequence[AnyCase], some: int | None, seed: int = 0) -> list[AnyCase]:
    """Returns all cases, or a random subset in random order."""
    if some is None:
        return list(every)
    order = np.random.default_rng(seed).permutation(len(every))
    return [every[index] for index in order[:some]]
