"""The visibility term, compiled; ``visible_shares`` is its readable form."""

from __future__ import annotations

import numpy as np

from regkit.interfaces.compiled import SceneArrays
from regkit.observation.compiled_blocks import observable_points
from regkit.system.compiled import compiled
from regkit.system.machine_types import Matrix, Vector
from regkit_plugins.terms.visibility.compiled import free_rays


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
    image = scene.data.silhouette
    if image.known:
        margins = np.empty(5 * count)
        for sample in range(len(margins)):
            margins[sample] = np.inf
        shown = observable_points(
            targets.reshape(5 * count, 3), margins, image.nearest, image.scale, image.offset
        )
        for k in range(count):
            seen = 0
            for sample in range(5 * k, 5 * k + 5):
                seen += shown[sample]
            shares[k] *= seen / 5.0
    for k in range(count):
        factors[k] = max(shares[k], numbers[0])
