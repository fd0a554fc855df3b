"""Search for the start: the best of many guesses, fitted to the cloud."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.interfaces import Template
from regkit.observation import Observation
from regkit.skeleton import Pose, PoseDescription
from regkit.start.cloud import cloud_pose
from regkit.start.fit import STIFFNESS, Stage, fitted
from regkit.start.guesses import Candidate, guesses
from regkit.start.scan import Scan
from regkit.system.errors import ConfigError
from regkit.system.optional import one_blas_thread

CUTOFF = 0.06
"""Distances beyond this fraction of the body's size count no more: an arm's width on a person."""

FAR, NEAR = 3.0, 0.4
"""Factors of the cutoff: the far one reveals limbs in the wrong place, the near one a wrong shape
unless noise hides it."""

COARSE = ((FAR, 5.0), (1.0, 5.0), (1.0, 1.0), (1.0, 0.2), (1.0, STIFFNESS))
"""Cutoff and stiffness of the first fits. The body first moves as a whole: a hand's parallel
fingers match the wrong data if they move before the hand is aligned."""

FINE = ((1.0, STIFFNESS), (NEAR, STIFFNESS))
"""Cutoff and stiffness of the last fits."""

LIKELY = 12
"""Number of guesses that are fitted in a middle size."""

FINALISTS = 3
"""Number of these fits that are refined in every candidate size."""

REFINEMENTS = 2
"""Number of times that the step between sizes is halved around the best size."""


@dataclass(frozen=True)
class Start:
    """The pose and size in the first frame of a recording.

    Attributes:
        body: The body at its size.
        pose: Its pose in the first frame.
    """

    body: Body
    pose: Pose


def given_start(template: Template, description: PoseDescription) -> Start:
    """Returns the start that a user specified.

    Raises:
        ConfigError: If the pose names a joint that the body does not have, or the size is unknown.
    """
    size = template.given_size()
    if size is None:
        raise ConfigError("a given start needs the template's size")
    body = template.body(size)
    return Start(body, body.skeleton.pose(description))


def found_start(template: Template, observation: Observation, *later: Observation) -> Start:
    """Returns the start that fits the first frame best.

    Every likely stance is placed at the cloud's centre, facing the camera, in several rotations.
    The best guesses are fitted to the cloud, the best fits are refined in every candidate size,
    annealed from far to near, and the best of these in sizes between the candidates. The search
    does not depend on shape models, kernels and solvers, so that all methods begin alike.

    Args:
        template: The template, possibly of unknown size.
        observation: The first frame.
        later: More frames; the one that fits best determines the size.

    Raises:
        ConfigError: If the template has no capsules, or no free root.
    """
    smallest = template.body(template.candidate_sizes()[0])
    rigid = smallest.skeleton.free and len(smallest.skeleton.names) == 1
    if rigid and smallest.surface is not None and not len(smallest.capsules):
        return Start(smallest, cloud_pose(smallest, smallest.surface, observation))
    if not smallest.skeleton.free or not len(smallest.capsules):
        lack = "free root" if not smallest.skeleton.free else "capsules"
        raise ConfigError(
            f"the template '{smallest.name}' has no {lack}, which the search for a start needs; "
            "give one (start:), and the template's size"
        )
    with one_blas_thread():
        return _found_start(template, [Scan(one.points) for one in (observation, *later)])


def _found_start(template: Template, scans: list[Scan]) -> Start:
    bodies = [template.body(size) for size in template.candidate_sizes()]
    if len(bodies) == 1:
        (best,) = _fits(scans[0], bodies)
        return Start(best.body, best.pose)
    fits = [_fits(scan, bodies) for scan in scans]
    # The best fit determines the size: a person who sits or folds the arms reveals it less well.
    bests = [min(of_frame, key=_misfit) for of_frame in fits]
    telling = int(np.argmin([best.misfit for best in bests]))
    sizes = [body.size for body in bodies]
    best = _resized(scans[telling], template, bests[telling], sizes)
    if telling:
        nearest = min(fits[0], key=lambda fit: abs(np.log(fit.body.size / best.body.size)))
        best = _fit(scans[0], best.body, nearest.pose, sizes[len(sizes) // 2], FINE)
    return Start(best.body, best.pose)


def _fits(scan: Scan, bodies: list[Body]) -> list[Candidate]:
    """Returns the best fit of each body to a cloud."""
    usual = bodies[len(bodies) // 2]
    rough = sorted(guesses(scan, usual, FAR * CUTOFF * usual.size), key=_misfit)[:LIKELY]
    coarse = [_fit(scan, usual, guess.pose, usual.size, COARSE) for guess in rough]
    finalists = sorted(coarse, key=_misfit)[:FINALISTS]
    return [
        min((_fit(scan, body, one.pose, usual.size, FINE) for one in finalists), key=_misfit)
        for body in bodies
    ]


def _resized(scan: Scan, template: Template, best: Candidate, sizes: list[float]) -> Candidate:
    """Returns the best fit in sizes between the candidates, halving their ratio repeatedly."""
    ratio, usual = sizes[1] / sizes[0], sizes[len(sizes) // 2]
    for _ in range(REFINEMENTS):
        ratio = np.sqrt(ratio)
        near = np.clip([best.body.size / ratio, best.body.size * ratio], sizes[0], sizes[-1])
        bodies = [template.body(float(size)) for size in near]
        tried = [_fit(scan, body, best.pose, usual, FINE) for body in bodies]
        best = min([best, *tried], key=_misfit)
    return best


def _fit(
    scan: Scan, body: Body, pose: Pose, usual: float, annealing: tuple[tuple[float, float], ...]
) -> Candidate:
    """Returns a fit from a pose with its misfit over all cutoffs, joint limits and size.

    All sizes share the cutoff of the usual size, since a longer cutoff is more lenient. A cloud
    that does not reveal the size, such as a sitting person's, favours the usual one.
    """
    cutoff = CUTOFF * usual
    found = fitted(scan, body, pose, [Stage(part * cutoff, stiff) for part, stiff in annealing])
    placement = body.place(found)
    misfits = [scan.misfit(body, placement, part * cutoff) for part in (FAR, 1.0, NEAR)]
    # With violated joint limits a body of the wrong size fits as well as the right one.
    strain = float(body.skeleton.limits.violation(found).max(initial=0.0))
    unusual = float(np.log(body.size / usual) ** 2)
    return Candidate(body, found, float(np.mean(misfits)) + strain + unusual)


def _misfit(candidate: Candidate) -> float:
    return candidate.misfit
