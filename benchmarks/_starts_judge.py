"""Judges of starts: the error after registration from them, their verdicts and their time."""

from __future__ import annotations

import time
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from _starts_case import Case
from _starts_shots import Shots
from _starts_truth import true_start

from regkit.body import Body
from regkit.interfaces import BoundTracker, Method, Past, Start, StartSearch, Template
from regkit.metrics.matching import matched
from regkit.observation import Observation, Truth
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.errors import RegkitError
from regkit.system.optional import one_thread

METHOD = {"preset": "best"}
"""The method that is registered from a start, with its tracker's recovery of limbs."""


def found(
    kind: str, template: Template, observations: Sequence[Observation], shots: Shots | None = None
) -> Start:
    """Returns the start in the first observation.

    Args:
        kind: Name of a search, or ``truth`` for the best start that there is.
        template: The template.
        observations: What the search is given.
        shots: The frames with their truth; only ``truth`` looks at it.
    """
    if kind == "truth":
        assert shots is not None
        return true_start(template, shots)
    search = StartSearch.parse(kind, place="benchmark", field="start")
    return search.find(template, observations)


@dataclass(frozen=True)
class Outcome:
    """What became of a start.

    Attributes:
        case: The case in words.
        errors: Distance of each joint to the truth after the registration, (J,) [m]; infinite if
            the search failed.
        start_error: Mean distance in the start itself [m].
        verdict: The start's verdict; empty if the search gives none.
        reason: Why the body is not surely found.
        size: The body's size [m].
        seconds: Processor time of the search [s].
    """

    case: str
    errors: Array
    start_error: float
    verdict: str
    reason: str
    size: float
    seconds: float

    @property
    def error(self) -> float:
        """Returns the mean error of the joints [m]."""
        return float(self.errors.mean())

    @property
    def parts(self) -> list[str]:
        """Returns the parts of the case's name."""
        return self.case.split(", ")

    @property
    def sure(self) -> bool:
        """Returns whether the search says that the body is found."""
        return self.verdict in ("", "found")

    def __str__(self) -> str:
        """Returns one line."""
        return (
            f"{100 * self.error:6.1f} cm, start {100 * self.start_error:6.1f}, {self.size:.3f} m, "
            f"{self.seconds:5.2f} s, {self.verdict or 'no verdict'}, {self.case} {self.reason}"
        )


def judged(kind: str, case: Case, *, sized: bool = True) -> Outcome:
    """Returns what becomes of the start in a case's first frame.

    Args:
        kind: Name of the search.
        case: The case.
        sized: Whether the template has the right size; otherwise the size is found from all frames.
    """
    sized = sized or kind == "truth"
    template = case.subject.sized() if sized else case.subject.unsized()
    observations = case.observations()[: 1 if sized else None]
    shots, joints = case.shots(), case.judged_joints()
    with one_thread():
        if kind != "truth":
            _prepare(kind, template, observations)
        begun = time.process_time()
        try:
            start = found(kind, template, observations, shots)
        except RegkitError as error:
            spent, missed = time.process_time() - begun, np.full(len(joints), np.inf)
            return Outcome(case.name, missed, np.inf, "refused", str(error), np.nan, spent)
        spent = time.process_time() - begun
        registered = bound(start.body).step(observations[0], Past.start(start.pose))
    return Outcome(
        case.name,
        distances(start.body, registered.pose, shots)[joints],
        float(distances(start.body, start.pose, shots)[joints].mean()),
        str(start.verdict),
        start.reason,
        start.body.size,
        spent,
    )


_PREPARED: set[str] = set()
"""Searches and templates of this process whose loops are compiled and whose atlas is loaded."""


def _prepare(kind: str, template: Template, observations: Sequence[Observation]) -> None:
    """Searches once, untimed, with a search and template that are new in this process."""
    key = f"{kind} {template.model_dump_json()}"
    if key not in _PREPARED:
        _PREPARED.add(key)
        with suppress(RegkitError):
            found(kind, template, observations)


def bound(body: Body) -> BoundTracker:
    """Returns the method's tracker bound to a body; bodies of equal size and name share it."""
    return _bound(_Known(body))


class _Known:
    """A body that equals those of the same name, size and lengths."""

    def __init__(self, body: Body) -> None:
        self.body = body
        self._key = (body.name, body.size, body.skeleton.link_offsets.tobytes())

    def __hash__(self) -> int:
        return hash(self._key)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Known) and self._key == other._key


@lru_cache(maxsize=8)
def _bound(known: _Known) -> BoundTracker:
    method = Method.parse(METHOD, place="benchmark", field="method")
    assert method.tracker is not None
    return method.tracker.bind(method.bind(known.body))


def distances(body: Body, pose: Pose, shots: Shots, frame: int = 0) -> Array:
    """Returns the distances (J,) [m] of a body's markers to the joints of a frame."""
    _, markers = matched(body, Truth(shots.joints, shots.truth), {})
    assert len(markers) == len(shots.joints)
    placed = body.markers.place(body.place(pose).transforms)[markers]
    return np.asarray(np.linalg.norm(placed - shots.truth[frame], axis=1))
