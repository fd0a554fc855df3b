"""Searching for the start: many guesses, the best of them fitted, the best fit kept."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.errors import ConfigError
from regkit.interfaces import Template
from regkit.observation import Observation
from regkit.optional import one_blas_thread
from regkit.skeleton import Pose, PoseDescription
from regkit.start.fit import fitted
from regkit.start.guesses import Candidate, guesses
from regkit.start.scan import Scan

REACH = 0.06
"""Gaps beyond this part of the body's size count no more: an arm's width on a person."""

FAR, NEAR = 3.0, 0.4
"""Parts of the reach: the far one sees limbs in the wrong place, the near one a wrong shape, unless
noise hides it."""

LIKELY = 12
"""How many guesses are fitted, in a middle size."""

FINALISTS = 3
"""How many of these are fitted in every candidate size."""


@dataclass(frozen=True)
class Start:
    """Where a sequence begins.

    Attributes:
        body: The body at its size.
        pose: Its pose in the first frame.
    """

    body: Body
    pose: Pose


def given_start(template: Template, description: PoseDescription) -> Start:
    """The start that a user wrote down.

    Raises:
        ConfigError: If it turns a joint that the body does not have, or the size is not known.
    """
    size = template.given_size()
    if size is None:
        raise ConfigError("a given start needs the template's size too")
    body = template.body(size)
    return Start(body, body.skeleton.pose(description))


def found_start(template: Template, observation: Observation) -> Start:
    """The start that fits the first frame best.

    Every likely stance is placed at the cloud's centre, facing the camera, in every turn. The best
    of these guesses are fitted to the cloud; those that then fit best are fitted in every
    candidate size, annealed from far to near, and the best fit is kept. Shape models, kernels and
    solvers play no part, so that all methods begin alike.

    Args:
        template: What is seen, perhaps of unknown size.
        observation: The first frame.

    Raises:
        ConfigError: If the template has no capsules, or a root that does not move freely.
    """
    smallest = template.body(template.candidate_sizes()[0])
    if not smallest.skeleton.free or not len(smallest.capsules):
        lack = "free root" if not smallest.skeleton.free else "capsules"
        raise ConfigError(
            f"the template '{smallest.name}' has no {lack}, without which no start can be found; "
            "give one (start:), and the template's size"
        )
    with one_blas_thread():
        return _found_start(template, Scan(observation.points))


def _found_start(template: Template, scan: Scan) -> Start:
    bodies = [template.body(size) for size in template.candidate_sizes()]
    usual = bodies[len(bodies) // 2]
    rough = sorted(guesses(scan, usual, FAR * REACH * usual.size), key=_misfit)[:LIKELY]
    coarse = sorted((_fit(scan, usual, guess.pose, (FAR, 1.0)) for guess in rough), key=_misfit)
    fine = [
        _fit(scan, body, finalist.pose, (1.0, NEAR))
        for finalist in coarse[:FINALISTS]
        for body in bodies
    ]
    # An unusual size has to fit a little better, for noise makes every cloud somewhat larger.
    best = min(fine, key=lambda c: c.misfit + np.log(c.body.size / usual.size) ** 2)
    return Start(best.body, best.pose)


def _fit(scan: Scan, body: Body, pose: Pose, annealing: tuple[float, ...]) -> Candidate:
    """A body fitted from a pose; it is judged from far to near, and by its joints."""
    reach = REACH * body.size
    found = fitted(scan, body, pose, [part * reach for part in annealing])
    placement = body.place(found)
    misfits = [scan.misfit(body, placement, part * reach) for part in (FAR, 1.0, NEAR)]
    # A body of the wrong size fits as well as the right one if its joints may bend as they cannot.
    strain = float(body.skeleton.limits.violation(found).max(initial=0.0))
    return Candidate(body, found, float(np.mean(misfits)) + strain)


def _misfit(candidate: Candidate) -> float:
    return candidate.misfit
