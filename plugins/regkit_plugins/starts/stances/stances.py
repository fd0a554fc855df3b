"""The search for the start among likely stances, each fitted to the cloud."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Literal

import numpy as np

from regkit.body import Body
from regkit.config.plugin import slot_default
from regkit.interfaces import Method, Start, StartSearch, Template
from regkit.observation import Observation
from regkit.start import (
    Candidate,
    FreeRoot,
    Scan,
    at_root,
    is_fixed,
    judged,
    rigid_start,
    with_free_bodies,
    with_further_parts,
    with_parts,
)
from regkit.start.fit import STIFFNESS
from regkit.start.sizes import CUTOFF, FAR, fit, resized
from regkit.system.optional import one_blas_thread
from regkit_plugins.starts.stances.guesses import guesses

COARSE = ((FAR, 5.0), (1.0, 5.0), (1.0, 1.0), (1.0, 0.2), (1.0, STIFFNESS))
"""Cutoff and stiffness of the first fits. The body first moves as a whole: a hand's parallel
fingers match the wrong data if they move before the hand is aligned."""

LIKELY = 12
"""Number of guesses that are fitted in a middle size."""

FINALISTS = 3
"""Number of these fits that are refined in every candidate size."""


class Stances(StartSearch):
    """Fits every likely stance of the template, upright and facing a level camera.

    The stances are placed at the cloud's centre in several rotations. The best guesses are fitted
    to the cloud, the best fits are refined in every candidate size, annealed from far to near, and
    the best of these in sizes between the candidates.
    """

    kind: Literal["stances"] = "stances"

    method: Method = slot_default(Method)
    """Method that registers the parts of a composed body."""

    def find(self, template: Template, observations: Sequence[Observation]) -> Start:
        """Returns the start that fits the first frame best.

        A body whose root is fixed is sought with a free one.

        Raises:
            ConfigError: If the template has no capsules.
        """
        shown = with_further_parts(self.find, template, observations)
        inside = shown or with_parts(
            lambda base: self.find(base, observations), template, observations[0], self.method
        )
        beside = inside or with_free_bodies(self.find, template, observations, self.method)
        rigid = beside or rigid_start(template, observations[0])
        if rigid is not None:
            return rigid
        fixed = is_fixed(template)
        sought = FreeRoot(template=template) if fixed else template
        with one_blas_thread():
            best = min(_in_views(sought, observations), key=_misfit)
        body, pose = best.body, best.pose
        if fixed:
            body = template.body(body.size)
            pose = at_root(body, pose)
        return judged(body, pose, observations[0])


def _in_views(template: Template, observations: Sequence[Observation]) -> Iterator[Candidate]:
    """Yields the best fit of stances that face each camera, in the world."""
    for view in observations[0].each_view:
        scans = [
            Scan.of(one.seen_from(other))
            for one in observations
            for other in one.each_view
            if other.name == view.name
        ]
        found = _found(template, scans)
        # A start in the frame of the only camera needs no motion, nor its rounding.
        moved = found.pose.moved(view.T_world_camera) if observations[0].views else found.pose
        yield replace(found, pose=moved)


def _found(template: Template, scans: list[Scan]) -> Candidate:
    sizes = template.candidate_sizes()
    bodies = [template.body(size) for size in sizes]
    if len(bodies) == 1:
        (best,) = _fits(scans[0], bodies)
        return best
    fits = [_fits(scan, bodies) for scan in scans]
    # The best fit determines the size: a person who sits or folds the arms reveals it less well.
    bests = [min(of_frame, key=_misfit) for of_frame in fits]
    telling = int(np.argmin([best.misfit for best in bests]))
    best = resized(scans[telling], template, bests[telling], sizes)
    if telling:
        nearest = min(fits[0], key=lambda one: abs(np.log(one.body.size / best.body.size)))
        best = fit(scans[0], best.body, nearest.pose, sizes[len(sizes) // 2])
    return best


def _fits(scan: Scan, bodies: list[Body]) -> list[Candidate]:
    """Returns the best fit of each body to a cloud."""
    usual = bodies[len(bodies) // 2]
    rough = sorted(guesses(scan, usual, FAR * CUTOFF * usual.size), key=_misfit)[:LIKELY]
    coarse = [fit(scan, usual, guess.pose, usual.size, COARSE) for guess in rough]
    finalists = sorted(coarse, key=_misfit)[:FINALISTS]
    return [
        min((fit(scan, body, one.pose, usual.size) for one in finalists), key=_misfit)
        for body in bodies
    ]


def _misfit(candidate: Candidate) -> float:
    return candidate.misfit
