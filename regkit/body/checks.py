"""Checks of a template across its fields: lengths, stances, and shape modes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from regkit.body.modes import Modes
from regkit.config.model import Model, misplaced
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.skeleton import PoseDescription, Skeleton
from regkit.skeleton.description import SegmentDescription
from regkit.system.errors import ConfigError

LONGEST = 20.0
"""Maximum length of a part of a body, in sizes of the body; centimetres are beyond it."""

BEYOND_DEG = 1.0
"""Angle by which a stance may exceed a limit, as both are rounded [deg]."""


def check_lengths(
    model: type[Model], segments: Mapping[str, SegmentDescription], size: float
) -> None:
    """Refuses segments that are far larger than their body, as with a wrong unit.

    Args:
        model: The template's class, for the error.
        segments: Its segments.
        size: Its size [m].

    Raises:
        ValidationError: At the first length beyond ``LONGEST`` sizes.
    """
    for name, segment in segments.items():
        for length, *field in _lengths(segment):
            if length > LONGEST * size:
                raise misplaced(
                    model,
                    f"{length:g} m in a body of {size:g} m; the maximum is {LONGEST:g} times its "
                    "size",
                    *("segments", name, *field),
                )


def check_modes(
    model: type[Model],
    modes: Path | None,
    mesh: Path | None,
    segments: Mapping[str, SegmentDescription],
) -> None:
    """Refuses shape modes of another mesh or of other segments; files are read where they exist.

    Args:
        model: The template's class, for the error.
        modes: Its file of modes; None without one.
        mesh: Its file of a mesh; None without one.
        segments: Its segments.

    Raises:
        ValidationError: If the modes do not belong to the mesh or the segments.
        DataError: If a file is damaged.
    """
    if modes is None:
        return
    if mesh is None:
        raise misplaced(model, "shape modes displace a mesh, and there is none", "modes")
    if not modes.is_file() or not mesh.is_file():
        return
    read, vertices = Modes.read(modes), len(SkinnedMesh.read(mesh).vertices)
    if read.vertices.shape[1] != vertices:
        raise misplaced(
            model,
            f"{modes} displaces {read.vertices.shape[1]} vertices; {mesh} has {vertices}",
            "modes",
        )
    unknown = [label for label in read.labels if label not in segments]
    if unknown:
        raise misplaced(
            model,
            f"{modes} displaces '{unknown[0]}', which is not a segment (there are: "
            f"{', '.join(segments)})",
            "modes",
        )


def check_stances(
    model: type[Model], skeleton: Skeleton, stances: Mapping[str, PoseDescription]
) -> None:
    """Refuses stances that name unknown joints, or exceed the limits of known ones.

    Args:
        model: The template's class, for the error.
        skeleton: Its skeleton.
        stances: Its stances.

    Raises:
        ValidationError: At the first wrong joint of a stance.
    """
    for stance, description in stances.items():
        for joint, angles in description.joints.items():
            place = ("stances", stance, "joints", joint)
            try:
                pose = skeleton.pose(PoseDescription(joints={joint: angles}))
            except ConfigError as error:
                raise misplaced(model, error.message, *place) from None
            excess = np.degrees(skeleton.limits.violation(pose) - _at_rest(skeleton)).max()
            if excess > BEYOND_DEG:
                raise misplaced(
                    model,
                    f"{_shown(angles)} degrees exceed the joint's limits by {excess:.3g} degrees",
                    *place,
                )


def _at_rest(skeleton: Skeleton) -> Any:
    """Returns the violations of the rest pose, which a single joint's angle does not cause."""
    return skeleton.limits.violation(skeleton.rest())


def _lengths(segment: SegmentDescription) -> Iterator[tuple[Any, ...]]:
    """Yields the lengths of a segment [m], each with its field."""
    yield float(np.linalg.norm(segment.offset)), "offset"
    for index, capsule in enumerate(segment.capsules):
        for end in ("start", "end"):
            yield float(np.linalg.norm(getattr(capsule, end))), "capsules", index, end
        yield float(np.max(capsule.radius)), "capsules", index, "radius"
    for marker, point in segment.markers.items():
        yield float(np.linalg.norm(point)), "markers", marker


def _shown(angles: Any) -> str:
    return ", ".join(f"{angle:g}" for angle in np.atleast_1d(angles))
