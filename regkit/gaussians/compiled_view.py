"""Gaussians as a kernel sees them, and their forces from moments, in compiled functions.

The readable forms are ``Volume``, ``Visible`` and ``Frozen``.
"""

from __future__ import annotations

from math import log
from typing import NamedTuple

import numpy as np

from regkit.gaussians.compiled import inverses, stiffness_blocks, visible_sides, visible_wrenches
from regkit.gaussians.visible import DEPTH, FLATTENING
from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, Stack, Vector


class View(NamedTuple):
    """K Gaussians as a kernel sees them; the entries of the visible side are empty for others.

    Attributes:
        means: Means in the world, (K, 3) [m].
        precisions: P, inverse of the sum of model and data covariance, (K, 3, 3) [1/m^2].
        log_determinants: log |P|, (K,).
        log_volumes: log |C|, (K,).
        own: C^-1, inverse of the visible side's covariance, (K, 3, 3) [1/m^2].
        whole: As in ``Visible``, (K, 3, 3) [m^2].
        pulled: As in ``Visible``, (K, 3).
        rays: As in ``Visible``, (K, 3).
        reaches: As in ``Visible``, (K, 1) [m].
        distances: As in ``Visible``, (K, 1) [m].
    """

    means: Matrix
    precisions: Stack
    log_determinants: Vector
    log_volumes: Vector
    own: Stack
    whole: Stack
    pulled: Matrix
    rays: Matrix
    reaches: Matrix
    distances: Matrix


@compiled(python=False)
def view_of_volumes(centres: Matrix, axes: Stack, scales: Matrix, variance: float) -> View:
    """Returns the view of whole Gaussians, for a data variance [m^2]."""
    count = len(centres)
    precisions = np.empty((count, 3, 3))
    determinants, volumes = np.empty(count), np.empty(count)
    for k in range(count):
        a, b, c = scales[k, 0] ** 2, scales[k, 1] ** 2, scales[k, 2] ** 2
        volumes[k] = log(a * b * c)
        a, b, c = 1.0 / (a + variance), 1.0 / (b + variance), 1.0 / (c + variance)
        determinants[k] = log(a * b * c)
        for i in range(3):
            for j in range(i + 1):
                entry = axes[k, i, 0] * a * axes[k, j, 0] + axes[k, i, 1] * b * axes[k, j, 1]
                entry += axes[k, i, 2] * c * axes[k, j, 2]
                precisions[k, i, j] = precisions[k, j, i] = entry
    none, few, one = np.empty((0, 3, 3)), np.empty((0, 3)), np.empty((0, 1))
    return View(centres, precisions, determinants, volumes, none, none, few, few, one, one)


@compiled(python=False)
def view_of_visible_sides(centres: Matrix, axes: Stack, scales: Matrix, variance: float) -> View:
    """Returns the view of the visible sides for a camera at the origin, for a data variance."""
    means, covariances, whole, pulled, rays, reaches, distances = visible_sides(
        centres, axes, scales, DEPTH, FLATTENING
    )
    precisions, determinants = inverses(covariances, variance)
    own, volumes = inverses(covariances, 0.0)
    for k in range(len(determinants)):
        determinants[k] = -determinants[k]
    return View(
        means, precisions, determinants, volumes, own, whole, pulled, rays, reaches, distances
    )


@compiled(python=False)
def add_forces(
    view: View,
    centres: Matrix,
    mass: Vector,
    about: Stack,
    volume_power: float,
    frozen: bool,
    order: int,
    wrenches: Matrix,
    stiffness: Stack,
) -> None:
    """Adds the wrenches and blocks of moments; see ``Seen.wrenches`` and ``Moments.stiffness``.

    Args:
        view: The view whose densities the moments weight.
        centres: Centres of the primitives, (K, 3) [m].
        mass: As in ``Moments``, (K,).
        about: As in ``Moments``, (K, 3, 4).
        volume_power: As in ``GaussianSimilarity``.
        frozen: Whether the covariances keep their orientation.
        order: 1 for wrenches, 2 for blocks too.
        wrenches: Added to, (K, 6).
        stiffness: Added to, (K, 6, 6).
    """
    count = len(mass)
    relative = np.zeros((count, 3, 4))
    for k in range(count):
        relative[k, 0, 0] = relative[k, 1, 1] = relative[k, 2, 2] = 1.0
    if len(view.whole) and not frozen:
        shrinking = np.zeros((count, 3, 3))
        if volume_power != 0.0:
            for k in range(count):
                for i in range(3):
                    for j in range(3):
                        shrinking[k, i, j] = 0.5 * volume_power * mass[k] * view.own[k, i, j]
        found = visible_wrenches(
            mass,
            about,
            relative,
            view.precisions,
            shrinking,
            view.whole,
            view.pulled,
            view.rays,
            view.reaches,
            view.distances,
            DEPTH,
            FLATTENING,
        )
        for k in range(count):
            for i in range(6):
                wrenches[k, i] += found[k, i]
    else:
        pull = np.empty((3, 4))
        for k in range(count):
            p = view.precisions[k]
            for i in range(3):
                for j in range(4):
                    pull[i, j] = (
                        p[i, 0] * about[k, 0, j]
                        + p[i, 1] * about[k, 1, j]
                        + p[i, 2] * about[k, 2, j]
                    )
                wrenches[k, i] -= pull[i, 3]
            if not frozen:
                wrenches[k, 3] += pull[1, 2] - pull[2, 1]
                wrenches[k, 4] += pull[2, 0] - pull[0, 2]
                wrenches[k, 5] += pull[0, 1] - pull[1, 0]
    if order == 2:
        shift = np.empty((count, 3))
        for k in range(count):
            for i in range(3):
                shift[k, i] = centres[k, i] - view.means[k, i]
        blocks = stiffness_blocks(mass, about, relative, view.precisions, shift)
        for k in range(count):
            for i in range(6):
                for j in range(6):
                    stiffness[k, i, j] += blocks[k, i, j]
