"""Templates of parametric body models, whose capsules are fitted to the mean surface."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from regkit.body import ShapeParameters
from regkit.body.description import SizeDescription
from regkit.body.modes import Modes
from regkit.fitting.flesh import Flesh
from regkit.fitting.parts import parts_of
from regkit.fitting.segment_capsules import segment_capsules
from regkit.fitting.skin import decimation
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
    vertices: int | None = None,
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
        vertices: Number of vertices of the largest connected piece to keep; all vertices if None.
        shapes: Shape models of which each segment gets one fitted primitive.

    Raises:
        ConfigError: If the axes are invalid, or a shape model has no parameters to fit.
        DataError: If the file is missing or damaged, or has another layout.
    """
    fitted = {kind: parameters_of(kind) for kind in shapes}
    axes = body_axes(up or "y", front or "z")
    model = BodyModel.read(path, axes, scale=scale, modes=modes)
    with reading(path, "a body model that a template can describe"):
        imported = _template(model, path, title or f"The body model of {path.name}", fitted)
        return imported if vertices is None else _decimated(imported, vertices)


def _template(
    model: BodyModel, path: Path, title: str, shapes: Mapping[str, type[ShapeParameters]]
) -> ImportedSkeleton:
    mesh = model.mesh
    _check_extent(mesh)
    parts = parts_of(mesh)
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


def _decimated(imported: ImportedSkeleton, count: int) -> ImportedSkeleton:
    """Returns the template with some of its skin's vertices, and their modes."""
    assert imported.skin is not None
    skin, kept = decimation(imported.skin, count)
    modes = imported.modes
    if modes is not None:
        modes = replace(modes, vertices=modes.vertices[:, kept])
    return replace(imported, skin=skin, modes=modes)


def _check_extent(mesh: SkinnedMesh) -> None:
    """Checks that the surface has a volume, and that the joints are there.

    Raises:
        DataError: If it is a point, a line or a plane, or a joint is far from it.
    """
    extents = np.ptp(mesh.vertices, axis=0)
    if extents.min() <= FLAT * extents.max():
        raise DataError(
            f"v_template extends over {', '.join(f'{one:.4g}' for one in extents)} m; a body has "
            "a volume"
        )
    joints = mesh.rest[:, :3, 3]
    low, high = mesh.vertices.min(axis=0) - joints, joints - mesh.vertices.max(axis=0)
    away = np.maximum(low, high).max(axis=1)
    if away.max() > extents.max():
        joint = int(away.argmax())
        raise DataError(
            f"J_regressor places the joint '{mesh.labels[joint]}' {away[joint]:.3g} m outside the "
            f"vertices, which extend over {extents.max():.3g} m"
        )


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
