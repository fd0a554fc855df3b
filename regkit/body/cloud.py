"""Rigid clouds as bodies: a skeleton of one free segment with the cloud as surface."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from regkit.body import Body, BodyDescription
from regkit.geometry.surface import SkinnedSurface
from regkit.system.arrays import Array


def cloud_description(points: Array, markers: Mapping[str, Array]) -> BodyDescription:
    """Returns the description of one free segment.

    Its size is the diagonal of the points' bounding box.

    Args:
        points: Points in the segment's frame, (N, 3) [m].
        markers: Named points in the same frame, (3,) each [m].
    """
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    segment = {
        "joint": {"type": "free"},
        "markers": {name: tuple(map(float, at)) for name, at in markers.items()},
    }
    return BodyDescription.model_validate(
        {
            "title": "A rigid cloud",
            "size": {"name": "diagonal", "value": size, "range": (size, size)},
            "segments": {"cloud": segment},
        }
    )


def cloud_body(name: str, points: Array, markers: Mapping[str, Array] | None = None) -> Body:
    """Returns a body of one free segment with a cloud as surface.

    Args:
        name: Name of the body in messages.
        points: Points in the segment's frame, (N, 3) [m].
        markers: Named points in the same frame, (3,) each [m].
    """
    description = cloud_description(points, markers or {})
    surface = SkinnedSurface(
        segments=np.zeros((len(points), 1), dtype=np.intp),
        points=points[:, None],
        blend=np.ones((len(points), 1)),
        normals=None,
        faces=np.empty((0, 3), dtype=np.intp),
    )
    return replace(description.body(name, description.size.value), surface=surface)
