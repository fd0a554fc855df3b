"""The visibility term, compiled; ``visible_shares`` is its readable form."""

from __future__ import annotations

import numpy as np

from regkit.interfaces.compiled import SceneArrays
from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, Vector
from regkit_plugins.terms.visibility.compiled import free_rays

NEAREST = 1e-3
"""As in ``Silhouette``."""


@compiled(python=False)
def weigh(scene: SceneArrays, numbers: Vector, table: Matrix, factors: Vector) -> None:
    """Writes the visible fractions; the table has a row for each primitive: whether it hides."""
    count = len(factors)
    for k in range(count):
        factors[k] = 1.0
    if not scene.data.camera:
        return
    targets, radii = np.empty((count, 5, 3)), np.empty((count, 3))
    hiding = np.empty(count, np.bool_)
    for k in range(count):
        hiding[k] = table[k, 0] != 0.0
        shortest = 0
        for i in range(3):
            radii[k, i] = 2.0 * scene.primitives.scales[k, i]
            if radii[k, i] < radii[k, shortest]:
                shortest = i
        a, b = (shortest + 1) % 3, (shortest + 2) % 3
        for i in range(3):
            at = scene.centres[k, i]
            one = 0.5 * radii[k, a] * scene.axes[k, i, a]
            two = 0.5 * radii[k, b] * scene.axes[k, i, b]
            targets[k, 0, i] = at
            targets[k, 1, i], targets[k, 2, i] = at + one, at + two
            targets[k, 3, i], targets[k, 4, i] = at - one, at - two
    shares = free_rays(targets, scene.centres, scene.axes, radii, hiding)
    for k in range(count):
        shown = 0
        for sample in range(5):
            if _shown(scene, targets[k, sample, 0], targets[k, sample, 1], targets[k, sample, 2]):
                shown += 1
        factors[k] = max(shares[k] * shown / 5.0, numbers[0])


@compiled(python=False)
def _shown(scene: SceneArrays, x: float, y: float, z: float) -> bool:
    """Returns whether the picture would show a point if something were there."""
    image = scene.data.silhouette
    if not image.known:
        return True
    if z <= 0.0:
        return False
    depth = max(z, NEAREST)
    column = int(np.rint(x / depth * image.scale[0] + image.offset[0]))
    row = int(np.rint(y / depth * image.scale[1] + image.offset[1]))
    if not (0 <= column < image.nearest.shape[0] and 0 <= row < image.nearest.shape[1]):
        return False
    return bool(image.nearest[column, row] > 0.0)
