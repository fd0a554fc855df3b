"""The map from a mesh's bones to a template's segments."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from pydantic import RootModel

from regkit.body import BodyDescription
from regkit.config.document import Document
from regkit.config.model import did_you_mean
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.errors import ConfigError


class BoneMap(RootModel[dict[str, str | None]]):
    """The segment of each bone; null leaves a bone to the segment of its parent."""


def read_bone_map(path: Path) -> dict[str, str | None]:
    """Returns the bone map in a YAML file.

    Raises:
        RegkitError: If the file is missing or wrong.
    """
    return Document.read(path).validated(BoneMap).root


def owners_of_bones(
    mesh: SkinnedMesh, template: BodyDescription, bones: Mapping[str, str | None]
) -> dict[str, str]:
    """Returns the segment that each bone belongs to, by the bone's label.

    Args:
        mesh: The mesh.
        template: The template.
        bones: Segments of bones, None for the segment of the parent; bones that are not included
            belong to the segment of the same name.

    Raises:
        ConfigError: If a bone or a segment is unknown, a bone belongs to none, or a segment has no
            bone.
    """
    segments, labels = list(template.segments), list(mesh.labels)
    for bone, segment in bones.items():
        if bone not in labels:
            raise ConfigError(
                f"the mesh has no bone '{bone}' (it has: {', '.join(labels)})"
                + did_you_mean(bone, labels)
            )
        if segment is not None and segment not in segments:
            raise ConfigError(
                f"{bone}: '{segment}' is not a segment (there are: {', '.join(segments)})"
                + did_you_mean(segment, segments)
            )
    own = {label: label for label in labels if label in segments}
    _check_all_mapped(labels, own | dict(bones), segments)
    owners: dict[str, str] = {}
    for label, parent in zip(labels, mesh.parents, strict=True):
        segment = (own | dict(bones))[label]
        if segment is None and parent < 0:
            raise ConfigError(f"{label}: a bone without a parent needs a segment; it has null")
        owners[label] = owners[labels[parent]] if segment is None else segment
    return owners


def first_bones(mesh: SkinnedMesh, owners: Mapping[str, str]) -> dict[str, int]:
    """Returns the first bone of each segment, whose start is the segment's joint.

    Parents come first among the bones.
    """
    first: dict[str, int] = {}
    for bone, label in enumerate(mesh.labels):
        first.setdefault(owners[label], bone)
    return first


def _check_all_mapped(
    labels: Sequence[str], bones: Mapping[str, str | None], segments: Sequence[str]
) -> None:
    """Checks that every bone has a segment and every segment a bone.

    Raises:
        ConfigError: If a bone or a segment is unmapped.
    """
    unmapped = [label for label in labels if label not in bones]
    bare = [segment for segment in segments if segment not in bones.values()]
    if unmapped:
        raise ConfigError(
            f"no segment is named after the bones {', '.join(unmapped)}; map each of them in the "
            "map of bones, as 'bone: segment', or null for the segment of its parent"
            + (f" (no bone yet: {', '.join(bare)})" if bare else "")
        )
    if bare:
        raise ConfigError(
            f"no bone belongs to {', '.join(bare)}; every segment of the template needs one (the "
            f"bones are {', '.join(labels)})"
        )
