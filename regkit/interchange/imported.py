"""Templates from skeletons of other programs, independent of the file format."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from pydantic import ValidationError

from regkit.body import BodyDescription
from regkit.body.description import SizeDescription
from regkit.body.modes import Modes
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interchange.bones import (
    MIN_THICKNESS,
    Bone,
    extents_of,
    generated_capsules,
    offsets_of,
    vector,
)
from regkit.skeleton import SegmentDescription
from regkit.system.errors import DataError

FARTHEST = 1e6
"""Largest size of a skeleton [m]; that of a person in micrometres is larger."""

UPRIGHT = 0.8
"""The size is the height if that is at least this fraction of the largest extent."""


@dataclass(frozen=True)
class ImportedSkeleton:
    """An imported skeleton as a template.

    Attributes:
        description: The template.
        comments: Comments on the joints, by segment.
        shaped: Number of bones with generated capsules, for lack of a shape in the file.
        skin: Mesh of the surface in the file; None if it has none.
        modes: Shape modes of the skin; None if the file has none.
        modes_in_file: Number of shape modes in the file.
    """

    description: BodyDescription
    comments: Mapping[str, str]
    shaped: int
    skin: SkinnedMesh | None = None
    modes: Modes | None = None
    modes_in_file: int = 0

    @classmethod
    def of(
        cls, bones: list[Bone], path: Path, title: str, *, spread: tuple[float, float]
    ) -> ImportedSkeleton:
        """Returns the template of the bones in a file.

        Args:
            bones: The bones, parents before children.
            path: The file, for messages and the template's source.
            title: Title of the template.
            spread: Range of the size, relative to the skeleton's own.

        Raises:
            DataError: If the skeleton has no extent, or is not a valid template.
        """
        try:
            description = _description(bones, path, title, spread)
        except ValidationError as error:
            problem = error.errors(include_url=False)[0]
            where = ".".join(str(part) for part in problem["loc"])
            message = problem["msg"].removeprefix("Value error, ")
            raise DataError(f"{where}: {message}", place=str(path)) from None
        segments = description.segments
        shaped = sum(bone.capsules is None and bool(segments[bone.name].capsules) for bone in bones)
        comments = {bone.name: bone.comment for bone in bones if bone.comment}
        return cls(description, comments, shaped)


def _description(
    bones: list[Bone], path: Path, title: str, spread: tuple[float, float]
) -> BodyDescription:
    """Returns the description of the bones.

    Raises:
        DataError: If the skeleton has no extent, or an absurd one.
        ValidationError: If it is not a valid template.
    """
    extents = extents_of(bones)
    upright = extents[1] >= UPRIGHT * extents.max()
    size = round(float(extents[1] if upright else extents.max()), 4)
    if not size <= FARTHEST:
        raise DataError(
            f"the skeleton extends over {size:.3g} m; a length in the file is wrong, or the scale",
            place=str(path),
        )
    if size <= 0.0:
        raise DataError(
            "the skeleton has no extent: all joints are at the same position; at least one bone "
            "must have a length",
            place=str(path),
        )
    offsets = offsets_of(bones)
    min_radius = MIN_THICKNESS * float(extents.max())
    segments = {}
    for index, bone in enumerate(bones):
        made = bone.capsules is None
        capsules = generated_capsules(offsets[index], min_radius) if made else bone.capsules
        segments[bone.name] = SegmentDescription(
            parent=bones[bone.parent].name if bone.parent >= 0 else None,
            offset=vector(bone.offset),
            joint=bone.joint,
            capsules=capsules or (),
            markers={name: vector(point) for name, point in bone.markers.items()},
        )
    return BodyDescription(
        title=title,
        sources=(f"Skeleton: imported from {path.name}",),
        size=SizeDescription(
            name="height" if upright else "length",
            value=size,
            range=(spread[0] * size, spread[1] * size),
        ),
        segments=segments,
    )
