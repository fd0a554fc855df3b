"""Kernels of Gaussians in compiled functions: what ``GaussianSimilarity`` does, step by step.

The numbers of such a part begin with whether its primitives show their visible side, and whether
covariances are frozen. Its state has a row for each Gaussian, and one for the kernel's own numbers.
"""

from __future__ import annotations

import numpy as np

from regkit.gaussians.compiled_pairs import pair_densities
from regkit.gaussians.compiled_view import View, view_of_visible_sides, view_of_volumes
from regkit.interfaces.compiled import SceneArrays
from regkit.primitives import Gaussians, Primitives, SurfaceGaussians
from regkit.system.compiled import compiled
from regkit.system.machine_types import (
    Matrix,
    SingleMatrix,
    SingleVector,
    Stack,
    Vector,
)

SHOWS_SURFACE, IS_FROZEN, OWN = 0, 1, 2
"""Indices of the numbers; a kernel's own begin at ``OWN``."""

LOG_WEIGHT, LOG_DETERMINANT, LOG_VOLUME, MEAN, PRECISION, COLUMNS = 0, 1, 2, 3, 6, 15
"""First columns of the state: what a frozen view takes from the start, and their number."""


def shows_surface(primitives: Primitives) -> bool | None:
    """Returns whether primitives show their visible side; None for other types of primitives."""
    if type(primitives) is SurfaceGaussians:
        return True
    return False if type(primitives) is Gaussians else None


@compiled(python=False)
def start_view(scene: SceneArrays, numbers: Vector, state: Matrix) -> View:
    """Returns the view in the start pose, and writes it into the state."""
    variance = scene.data.variance + scene.smoothing**2
    view = _view(scene, scene.centres, scene.axes, numbers, variance)
    for k in range(len(scene.centres)):
        state[k, LOG_DETERMINANT] = view.log_determinants[k]
        state[k, LOG_VOLUME] = view.log_volumes[k]
        for i in range(3):
            state[k, MEAN + i] = view.means[k, i] - scene.centres[k, i]
            for j in range(3):
                state[k, PRECISION + 3 * i + j] = view.precisions[k, i, j]
    return view


@compiled(python=False)
def view_now(
    scene: SceneArrays, centres: Matrix, axes: Stack, numbers: Vector, state: Matrix
) -> View:
    """Returns the view of placed Gaussians."""
    if numbers[IS_FROZEN] != 0.0:
        return _frozen(centres, state)
    variance = scene.data.variance + scene.smoothing**2
    return _view(scene, centres, axes, numbers, variance)


@compiled(python=False)
def densities_now(
    scene: SceneArrays,
    view: View,
    state: Matrix,
    volume_power: float,
    densities: SingleMatrix,
    total: SingleVector,
) -> Matrix:
    """Writes the densities (K, N) and adds them to the total (N,); returns the relative means.

    Args:
        scene: The state at the start.
        view: The Gaussians.
        state: The state, which holds the logarithms of their weights.
        volume_power: As in ``GaussianSimilarity``.
        densities: Written, (K, N).
        total: Added to, (N,).
    """
    count = len(view.means)
    means, log_scales = np.empty((count, 3)), np.empty(count)
    for k in range(count):
        volume = volume_power * view.log_volumes[k]
        log_scales[k] = state[k, LOG_WEIGHT] + 0.5 * (view.log_determinants[k] + volume)
        for i in range(3):
            means[k, i] = view.means[k, i] - scene.data.centre[i]
    pair_densities(scene.data.centred, means, view.precisions, log_scales, densities, total)
    return means


@compiled(python=False)
def _view(
    scene: SceneArrays, centres: Matrix, axes: Stack, numbers: Vector, variance: float
) -> View:
    scales = scene.primitives.scales
    if scene.data.camera and numbers[SHOWS_SURFACE] != 0.0:
        return view_of_visible_sides(centres, axes, scales, variance)
    return view_of_volumes(centres, axes, scales, variance)


@compiled(python=False)
def _frozen(centres: Matrix, state: Matrix) -> View:
    """Returns the view in the start pose, moved with the centres."""
    count = len(centres)
    means, precisions = np.empty((count, 3)), np.empty((count, 3, 3))
    determinants, volumes = np.empty(count), np.empty(count)
    for k in range(count):
        determinants[k] = state[k, LOG_DETERMINANT]
        volumes[k] = state[k, LOG_VOLUME]
        for i in range(3):
            means[k, i] = centres[k, i] + state[k, MEAN + i]
            for j in range(3):
                precisions[k, i, j] = state[k, PRECISION + 3 * i + j]
    none, few, one = np.empty((0, 3, 3)), np.empty((0, 3)), np.empty((0, 1))
    return View(means, precisions, determinants, volumes, none, none, few, few, one, one)
