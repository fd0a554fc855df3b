"""Templates of parametric body models, whose capsules are fitted to the mean surface."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import scipy

from regkit.body import ShapeParameters
from regkit.body.description import SizeDescription
from regkit.body.modes import Modes
from regkit.fitting.flesh import Flesh, closed, divided, points_in_box
from regkit.fitting.layout import SegmentFrame
from regkit.fitting.segment_capsules import segment_capsules
from regkit.fitting.template import parameters_of
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interchange.axes import body_axes
from regkit.interchange.body_model.anatomy import ball_of, stances_of
from regkit.interchange.body_model.joints import HUMAN
from regkit.interchange.body_model.smpl import MODES, BodyModel
from regkit.interchange.bones import Bone, ball
from regkit.interchange.imported import UPRIGHT, ImportedSkeleton
from regkit.skeleton.joints import FreeJoint
from regkit.system.errors import DataError
from regkit.system.guard import reading

FINENESS = 100
"""Number of grid points along the model's largest extent."""

ENOUGH = 100
"""A segment with fewer points inside is filled with a finer grid of about as many."""

BOX = 4
"""About the volume of the box around a segment, in volumes of the segment."""

FEWEST = 8
"""A segment with fewer points inside has no capsule, such as a joint without vertices."""

FLAT = 1e-3
"""A surface whose extent in one direction is below this part of the largest has no volume."""

SPREAD = (0.8, 1.25)
"""Range of the size relative to the model's own, without shape modes."""

LIKELY = 3.0
"""Range of the size by the shape modes, in standard deviations."""

LIMITS = (
    "Joint limits: AAOS, in Norkin & White, Measurement of Joint Motion, 5th ed.; knee: Hemmerich "
    "et al., 2006; others: clinical reference ranges, rounded, divided over the joints of the model"
)


def body_model_template(
    path: Path,
    *,
    scale: float = 1.0,
    title: str | None = None,
    up: str | None = None,
    front: str | None = None,
    modes: int = MODES,
    shapes: Sequence[str] = (),
) -> ImportedSkeleton:
    """Returns the template of a body model, in the model's own pose and with its own vertices.

    Each joint is a segment of its name, with a marker at its origin, and in the rest pose all
    segments are parallel: a joint's rotation is that of the model. Joints of a human body in a
    known layout have anatomical limits, others none.

    Args:
        path: An ``.npz`` file or a pickle in the layout of SMPL.
        scale: Metres per unit of the file.
        title: Title of the template; by default the name of the file.
        up: The up axis of the file; y by default.
        front: The front axis of the file; z by default.
        modes: Number of shape modes to take.
        shapes: Shape models of which each segment gets one fitted primitive.

    Raises:
        ConfigError: If the axes are invalid, or a shape model has no parameters to fit.
        DataError: If the file is missing or damaged, or has another layout.
    """
    fitted = {kind: parameters_of(kind) for kind in shapes}
    axes = body_axes(up or "y", front or "z")
    model = BodyModel.read(path, axes, scale=scale, modes=modes)
    with reading(path, "a body model that a template can describe"):
        return _template(model, path, title or f"The body model of {path.name}", fitted)


def _template(
    model: BodyModel, path: Path, title: str, shapes: Mapping[str, type[ShapeParameters]]
) -> ImportedSkeleton:
    mesh = model.mesh
    _check_extent(mesh)
    parts = _parts(mesh)
    bones = [_bone(model, index, parts[name]) for index, name in enumerate(mesh.labels)]
    if not any(bone.capsules for bone in bones):
        bones = [replace(bone, capsules=None) for bone in bones]
    imported = ImportedSkeleton.of(bones, path, title, spread=SPREAD)
    sources = imported.description.sources
    description = imported.description.model_copy(
        update={
            "size": _size(mesh, model.modes),
            "upright": model.family in HUMAN,
            "stances": stances_of(model.family),
            "shapes": {kind: _primitives(one, parts) for kind, one in shapes.items()},
            "sources": (*sources, LIMITS) if model.family in HUMAN else sources,
        }
    )
    return replace(
        imported,
        description=description,
        skin=mesh,
        modes=model.modes,
        modes_in_file=model.available,
    )


def _check_extent(mesh: SkinnedMesh) -> None:
    """Checks that the surface has a volume.

    Raises:
        DataError: If it is a point, a line or a plane.
    """
    extents = np.ptp(mesh.vertices, axis=0)
    if extents.min() <= FLAT * extents.max():
        raise DataError(
            f"v_template extends over {', '.join(f'{one:.4g}' for one in extents)} m; a body has "
            "a volume"
        )


def _parts(mesh: SkinnedMesh) -> dict[str, Flesh]:
    """Returns samples of each segment in its frame; small ones are as many as of large ones."""
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


def _bone(model: BodyModel, index: int, part: Flesh) -> Bone:
    """Returns a joint of the model, with a marker and capsules."""
    mesh, name = model.mesh, model.mesh.labels[index]
    origins, parent = mesh.rest[:, :3, 3], int(mesh.parents[index])
    ends = [origins[child] - origins[index] for child in np.flatnonzero(mesh.parents == index)]
    centre = part.interior.mean(axis=0) if len(part.interior) else None
    along = np.mean(ends, axis=0) if ends else centre
    joint = FreeJoint() if parent < 0 else ball_of(model.family, name) or ball(along)
    return Bone(
        name=name,
        parent=parent,
        offset=origins[index] - origins[parent] if parent >= 0 else np.zeros(3),
        joint=joint,
        capsules=segment_capsules(part) if len(part.interior) >= FEWEST else (),
        markers={name: np.zeros(3)},
    )


def _primitives(
    kind: type[ShapeParameters], parts: Mapping[str, Flesh]
) -> dict[str, tuple[ShapeParameters, ...]]:
    """Returns one primitive for each segment that is large enough."""
    return {
        name: (kind.fitted(part.interior),)
        for name, part in parts.items()
        if len(part.interior) >= FEWEST
    }


def _size(mesh: SkinnedMesh, modes: Modes | None) -> SizeDescription:
    """Returns the height, or the largest extent of a model that is wider than high.

    Its range follows from the modes: the vertices at both ends move with the coefficients, whose
    distribution is known.
    """
    extents = np.ptp(mesh.vertices, axis=0)
    upright = extents[1] >= UPRIGHT * extents.max()
    axis = 1 if upright else int(extents.argmax())
    size, places = float(extents[axis]), mesh.vertices[:, axis]
    low, high = SPREAD[0] * size, SPREAD[1] * size
    if modes is not None:
        moved = modes.vertices[:, [places.argmax(), places.argmin()], axis]
        rates = moved[:, 0] - moved[:, 1]
        deviation = LIKELY * float(np.sqrt(rates @ modes.covariance @ rates))
        low, high = max(size - deviation, low), min(size + deviation, high)
    return SizeDescription(
        name="height" if upright else "length",
        value=round(size, 4),
        range=(round(low, 4), round(high, 4)),
    )
