"""Samples of all bones of a mesh, as many of small ones as of large ones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy

from regkit.fitting.flesh import Flesh, closed, divided, points_in_box
from regkit.fitting.layout import SegmentFrame
from regkit.geometry.skinned_mesh import SkinnedMesh

FINENESS = 100
"""Number of grid points along the model's largest extent."""

ENOUGH = 100
"""A segment with fewer points inside is filled with a finer grid of about as many."""

BOX = 4
"""About the volume of the box around a segment, in volumes of the segment."""


def parts_of(mesh: SkinnedMesh) -> dict[str, Flesh]:
    """Returns samples of each bone, in a frame at its origin that is parallel to the mesh's.

    Args:
        mesh: The mesh, with frames that are parallel at rest.
    """
    labels, spacing = list(mesh.labels), float(np.ptp(mesh.vertices, axis=0).max()) / FINENESS
    parts = divided(mesh, np.eye(4), {label: label for label in labels}, labels, spacing)
    whole = closed(mesh.vertices, mesh.faces)
    owners = mesh.indices[np.arange(len(mesh.vertices)), mesh.weights.argmax(axis=1)]
    tree = scipy.spatial.cKDTree(mesh.vertices)
    for index, label in enumerate(labels):
        own = mesh.vertices[owners == index]
        if len(own) and len(parts[label].interior) < ENOUGH:
            points = points_in_box(*whole, own.min(axis=0), own.max(axis=0), BOX * ENOUGH)
            points = points[owners[tree.query(points)[1]] == index]
            parts[label] = replace(parts[label], interior=points)
    frames = [SegmentFrame(origin, np.eye(3)) for origin in mesh.rest[:, :3, 3]]
    return {label: parts[label].local(frame) for label, frame in zip(labels, frames, strict=True)}
