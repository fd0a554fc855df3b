"""Sizes: fits of a body to a cloud that are comparable between sizes."""

from __future__ import annotations

import numpy as np

from regkit.body import Body
from regkit.interfaces import Template
from regkit.skeleton import Pose
from regkit.start.candidate import Candidate
from regkit.start.fit import STIFFNESS, Stage, fitted
from regkit.start.scan import Scan

CUTOFF = 0.06
"""Distances beyond this fraction of the body's size count no more: an arm's width on a person."""

FAR, NEAR = 3.0, 0.4
"""Factors of the cutoff: the far one reveals limbs in the wrong place, the near one a wrong shape
unless noise hides it."""

FINE = ((1.0, STIFFNESS), (NEAR, STIFFNESS))
"""Cutoff and stiffness of the last fits."""

REFINEMENTS = 2
"""Number of times that the step between sizes is halved around the best size."""


def misfit(scan: Scan, body: Body, pose: Pose, usual: float) -> float:
    """Returns the misfit of a pose over all cutoffs, joint limits and size.

    All sizes share the cutoff of the usual size, since a longer cutoff is more lenient. A cloud
    that does not reveal the size, such as a sitting person's, favours the usual one.

    Args:
        scan: The cloud.
        body: The body.
        pose: Its pose.
        usual: The template's usual size [m].
    """
    placement, cutoff = body.place(pose), CUTOFF * usual
    misfits = [scan.misfit(body, placement, part * cutoff) for part in (FAR, 1.0, NEAR)]
    # With violated joint limits a body of the wrong size fits as well as the right one.
    strain = float(body.skeleton.limits.violation(pose).max(initial=0.0))
    unusual = float(np.log(body.size / usual) ** 2)
    return float(np.mean(misfits)) + strain + unusual


def fit(
    scan: Scan,
    body: Body,
    pose: Pose,
    usual: float,
    annealing: tuple[tuple[float, float], ...] = FINE,
) -> Candidate:
    """Returns a fit from a pose, with its misfit.

    Args:
        scan: The cloud.
        body: The body.
        pose: Initial pose.
        usual: The template's usual size [m].
        annealing: Cutoff, as a factor of ``CUTOFF``, and stiffness of each fit.
    """
    cutoff = CUTOFF * usual
    found = fitted(scan, body, pose, [Stage(part * cutoff, stiff) for part, stiff in annealing])
    return Candidate(body, found, misfit(scan, body, found, usual))


def resized(scan: Scan, template: Template, best: Candidate, sizes: tuple[float, ...]) -> Candidate:
    """Returns the best fit in sizes between the candidates, halving their ratio repeatedly.

    Args:
        scan: The cloud.
        template: The template.
        best: The best fit in one of the sizes.
        sizes: The candidate sizes, ascending [m].
    """
    ratio, usual = sizes[1] / sizes[0], sizes[len(sizes) // 2]
    for _ in range(REFINEMENTS):
        ratio = float(np.sqrt(ratio))
        near = np.clip([best.body.size / ratio, best.body.size * ratio], sizes[0], sizes[-1])
        tried = [fit(scan, template.body(float(size)), best.pose, usual) for size in near]
        best = min([best, *tried], key=lambda candidate: candidate.misfit)
    return best
