"""A template fitted to a mesh."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from regkit.body import BodyDescription, ParametricShape, ShapeParameters
from regkit.body.modes import Modes
from regkit.body.proportions import Proportions, height
from regkit.fitting.bones import first_bones, owners_of_bones
from regkit.fitting.carried_modes import carried_modes
from regkit.fitting.flesh import Flesh, divided
from regkit.fitting.layout import Layout
from regkit.fitting.mesh_shape import MeshShape
from regkit.fitting.posture import Posture
from regkit.fitting.sides import check_sides
from regkit.fitting.skin import decimation, on_segments
from regkit.geometry.rigid import inverse, rigid, transformed
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.skeleton.description import parents_first
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError

FINENESS = 150
"""Number of grid points along the template's size."""

FEWEST = 8
"""Minimum number of points inside a segment for each of its primitives."""

UNITS = {"millimetres": 1e-3, "centimetres": 1e-2, "inches": 0.0254, "feet": 0.3048}
"""Other units of lengths [m]."""

WIDER = 1.25
"""A size in another unit may be outside the template's sizes by this factor."""

SPREAD = 10.0
"""Largest ratio between the extents of a mesh's vertices and of its joints."""

LIKELY = 2.0
"""A mesh outside the template's sizes by more than this factor has other units."""


@dataclass(frozen=True)
class FittedTemplate:
    """A template fitted to a mesh.

    Attributes:
        description: The template, at the mesh's size.
        skin: The mesh with the template's segments as bones.
        owners: Segment of each bone of the mesh.
        proportions: Ratios of the mesh's lengths and girths to the template's.
        modes: Shape modes of the segments and the skin; None if the mesh has none.
    """

    description: BodyDescription
    skin: SkinnedMesh
    owners: Mapping[str, str]
    proportions: Proportions
    modes: Modes | None = None

    @classmethod
    def to(
        cls,
        mesh: SkinnedMesh,
        template: BodyDescription,
        bones: Mapping[str, str | None],
        vertices: int,
        shapes: Sequence[str] = (),
        modes: Modes | None = None,
    ) -> FittedTemplate:
        """Returns a template with the joints of another, in the shape of a mesh.

        Args:
            mesh: The mesh, in any pose and in any axes.
            template: Template that provides joints, limits, stances, and the number of primitives
                per segment and shape model.
            bones: Segment of each bone; see ``owners_of_bones``.
            vertices: Number of the mesh's vertices to keep.
            shapes: Further shape models to fit: one primitive per segment, unless the template
                lists others.
            modes: Shape modes of the mesh's bones and vertices, if it has any.

        Raises:
            ConfigError: If bones and segments do not match, or a shape model has no parameters
                to fit.
            DataError: If the mesh does not resemble the template's body.
        """
        if not template.shapes:
            raise DataError("the template lists no shapes, so there is nothing to fit")
        added = {kind: parameters_of(kind) for kind in shapes if kind not in template.shapes}
        template.check_shapes()
        owners = owners_of_bones(mesh, template, bones)
        starts = mesh.rest[:, :3, 3]
        bones_of = first_bones(mesh, owners)
        joints = {name: starts[bone] for name, bone in bones_of.items()}
        posture = Posture(template, joints)
        axes, origin = posture.root()
        T_template_mesh = inverse(rigid(axes, origin))
        joints = {name: transformed(T_template_mesh, at[None])[0] for name, at in joints.items()}
        joints[parents_first(template.segments)[0]] = np.zeros(3)
        size = _rough_size(template, joints)
        _check_extent(mesh, joints)
        parts = divided(mesh, T_template_mesh, owners, list(template.segments), size / FINENESS)
        _check_filled(template, parts)
        check_sides(
            template, joints, {name: part.interior.mean(axis=0) for name, part in parts.items()}
        )
        frames = Posture(template, joints).frames(parts)
        layout = Layout(T_template_mesh, owners, frames)
        shape = MeshShape(template, layout, parts, added)
        description = shape.description()
        skin, kept = decimation(on_segments(mesh, layout, description), vertices)
        sized = _sized(description, template, skin)
        if modes is not None:
            modes = carried_modes(modes, axes.T, bones_of, posture.root_shares(), kept)
        return cls(sized, skin, owners, shape.proportions(), modes)


def parameters_of(kind: str) -> type[ShapeParameters]:
    """Returns the class of a shape model's parameters.

    Raises:
        ConfigError: If it has none.
        PluginError: If there is no such shape model.
    """
    parameters = ParametricShape.parameters_of(kind)
    if parameters is None:
        raise ConfigError(f"the shape model '{kind}' has no parameters that could be fitted")
    return parameters


def _rough_size(template: BodyDescription, joints: Mapping[str, Array]) -> float:
    """Returns the size estimated from the distances of joints [m].

    Raises:
        DataError: If the size is far from the template's range.
    """
    parents = {name: one.parent for name, one in template.segments.items() if one.parent}
    own = sum(float(np.linalg.norm(template.segments[name].offset)) for name in parents)
    found = sum(float(np.linalg.norm(joints[name] - joints[to])) for name, to in parents.items())
    low, high = template.size.range
    size = template.size.value * (found / own if own > 0.0 else 1.0)
    if not low / LIKELY <= size <= high * LIKELY:
        raise DataError(
            f"by its joints the mesh has a {template.size.name} of {size:.4g} m; the template's is "
            f"{low:g} to {high:g} m: lengths must be in metres" + _unit(size, low, high)
        )
    return size


def _unit(size: float, low: float, high: float) -> str:
    """Returns the end of a message that names the unit in which a size is likely given."""
    for name, metres in UNITS.items():
        if low / WIDER <= metres * size <= high * WIDER:
            return f"; these may be {name}, multiply all lengths by {metres:g}"
    return ""


def _check_extent(mesh: SkinnedMesh, joints: Mapping[str, Array]) -> None:
    """Checks that vertices and bones have the same unit and are in the same place.

    Raises:
        DataError: If the vertices extend much further than the joints, or hardly at all.
    """
    places = np.array(list(joints.values()))
    vertices = float(np.ptp(mesh.vertices, axis=0).max())
    bones = float(np.ptp(places, axis=0).max())
    if bones > 0.0 and not bones / SPREAD <= vertices <= bones * SPREAD:
        raise DataError(
            f"the mesh's vertices extend over {vertices:.4g} m and its bones over {bones:.4g} m; "
            "both must have one unit, and no vertex may be far from the body"
        )


def _sized(
    description: BodyDescription, template: BodyDescription, skin: SkinnedMesh
) -> BodyDescription:
    """Returns the description with the size that follows from its height (along y, at rest)."""
    own, other = (one.body("rest", one.size.value) for one in (description, template))
    transforms = own.place(own.skeleton.rest()).transforms
    if other.surface is None:
        ratio = height(description) / height(template)
    else:
        order = [own.skeleton.names.index(label) for label in skin.labels]
        before = other.surface.place(other.place(other.skeleton.rest()).transforms)
        ratio = float(np.ptp(skin.posed(transforms[order])[:, 1]) / np.ptp(before[:, 1]))
    size = round(template.size.value * ratio, 4)
    given = template.size.model_copy(update={"value": size, "range": (size, size)})
    return description.model_copy(update={"size": given})


def _check_filled(template: BodyDescription, parts: Mapping[str, Flesh]) -> None:
    """Checks that the mesh encloses every segment.

    Raises:
        DataError: If a segment has too few points for its primitives.
    """
    for name, part in parts.items():
        most = max(len(by_segment.get(name, ())) for by_segment in template.shapes.values())
        if len(part.interior) < FEWEST * max(most, 1):
            raise DataError(
                f"the mesh encloses nothing, or too little, at '{name}': its surface must be "
                "closed, and vertices must follow the segment's bones"
            )
