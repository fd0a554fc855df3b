"""Judges of starts: the error after registration from them, their verdicts and their time."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from _starts_shots import Shots

from regkit.body import Body
from regkit.interfaces import BoundTracker, Method, Past, Start, StartSearch, Template
from regkit.metrics.matching import matched
from regkit.observation import Observation, Truth
from regkit.system.arrays import Array
from regkit.system.errors import RegkitError

METHOD = {"preset": "best"}
"""The method that is registered from a start, with its tracker's recovery of limbs."""


def found(kind: str, template: Template, observations: Sequence[Observation]) -> Start:
    """Returns the start of a search by its name."""
    return StartSearch.parse(kind, place="benchmark", field="start").find(template, observations)


@dataclass(frozen=True)
class Outcome:
    """What became of a start.

    Attributes:
        errors: Distance of each joint to the truth after the registration, (J,) [m]; infinite if
            the search failed.
        start_errors: The same in the start itself, (J,) [m].
        verdict: The start's verdict; empty if the search gives none.
        reason: Why the body is not surely found.
        size: The body's size [m].
        seconds: Processor time of the search [s].
    """

    errors: Array
    start_errors: Array
    verdict: str
    reason: str
    size: float
    seconds: float

    def error(self, chosen: Sequence[int] | None = None) -> float:
        """Returns the mean error of the joints, or of those chosen by their indices [m]."""
        errors = self.errors if chosen is None else self.errors[np.asarray(chosen)]
        return float(errors.mean())


@dataclass(frozen=True)
class Judge:
    """Finds starts and registers from them; what is bound to a body is kept.

    Attributes:
        kind: Name of the search.
    """

    kind: str
    _bound: dict[tuple[str, float], BoundTracker] = field(default_factory=dict)

    def outcome(
        self, template: Template, observations: Sequence[Observation], shots: Shots
    ) -> Outcome:
        """Returns what becomes of the start in the first observation.

        Args:
            template: The template, possibly of unknown size.
            observations: The frames that the search is given, those of ``shots`` from the first.
            shots: The frames with their truth.
        """
        begun = time.process_time()
        try:
            start = found(self.kind, template, observations)
        except RegkitError as error:
            spent, missed = time.process_time() - begun, np.full(len(shots.joints), np.inf)
            return Outcome(missed, missed, "refused", str(error), np.nan, spent)
        spent = time.process_time() - begun
        tracker = self.tracker(template, start.body)
        registered = tracker.step(observations[0], Past.start(start.pose))
        truth = Truth(shots.joints, shots.truth[:1])
        return Outcome(
            joint_distances(start.body, registered.pose, truth),
            joint_distances(start.body, start.pose, truth),
            str(getattr(start, "verdict", "")),
            str(getattr(start, "reason", "")),
            start.body.size,
            spent,
        )

    def tracker(self, template: Template, body: Body) -> BoundTracker:
        """Returns the method's tracker bound to a body."""
        key = (template.model_dump_json(exclude={"height", "length", "size"}), round(body.size, 4))
        if key not in self._bound:
            # Bodies of found sizes differ from case to case, so only a few are kept.
            while len(self._bound) >= 8:
                self._bound.pop(next(iter(self._bound)))
            method = Method.parse(METHOD, place="benchmark", field="method")
            assert method.tracker is not None
            self._bound[key] = method.tracker.bind(method.bind(body))
        return self._bound[key]


def joint_distances(body: Body, pose, truth: Truth) -> Array:
    """Returns the distance (J,) [m] of a body's markers to the joints of the first frame."""
    columns, markers = matched(body, truth, {})
    placed = body.markers.place(body.place(pose).transforms)[markers]
    return np.linalg.norm(placed - truth.positions[0, columns], axis=1)
