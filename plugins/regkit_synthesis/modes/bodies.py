"""Bodies and hands drawn from anny, which is installed for this alone (``pip install anny``)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from importlib import import_module
from typing import Any

import numpy as np

from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError

YOUNGEST, OLDEST = 16.0, 85.0
"""Ages that are drawn, evenly, in years."""

LOCAL = 0.25
"""Standard deviation of local changes, as a fraction of the largest one that a target makes."""

BATCH = 20
"""Number of bodies that are made at once."""

BODY_TARGETS = (
    "measure-", "arm-", "upperarm", "lowerarm", "breast-dist", "breast-volume", "buttocks",
    "foot-scale", "hand-scale", "hand-fingers", "head-scale", "head-fat", "head-back", "hip-",
    "leg-", "lowerleg", "upperleg", "neck", "bulge", "pelvis", "stomach-pregnant", "stomach-tone",
    "torso-muscle", "torso-scale", "torso-vshape", "chin-",
)  # fmt: skip
"""Parts of the names of local changes that change a body's shape, and not its face."""

HAND_TARGETS = ("hand-scale", "hand-fingers-length", "hand-fingers-diameter", "measure-wrist")
"""The same of a hand's shape; the distance of the fingers is their pose."""

LEFT_OUT = ("trans", "navel", "nipple", "double")
"""Parts of the names of changes that are poses, or smaller than what a depth camera shows."""


@dataclass(frozen=True)
class Bodies:
    """Bodies drawn at random.

    Attributes:
        meshes: Their meshes, (N,).
        phenotypes: Their phenotypes, such as age, by name, (N,) each.
    """

    meshes: tuple[SkinnedMesh, ...]
    phenotypes: Mapping[str, Array]


def people(like: SkinnedMesh, count: int, seed: int, *, local: float = LOCAL) -> Bodies:
    """Returns people drawn at random, with the topology and the bones of a mesh.

    Args:
        like: The average body.
        count: Number N of people.
        seed: Seed of the random numbers.
        local: Standard deviation of the local changes.

    Raises:
        ConfigError: If anny is not installed, or its bodies have another topology.
    """
    model = _anny().create_fullbody_model(
        rig="cmu_mb", topology="default", local_changes="all", triangulate_faces=True
    )
    return _drawn(model, like, count, seed, BODY_TARGETS, local)


def hands(like: SkinnedMesh, count: int, seed: int, *, local: float = LOCAL) -> Bodies:
    """Returns right hands drawn at random, with the topology and the bones of a mesh.

    Args:
        like: The average hand.
        count: Number N of hands.
        seed: Seed of the random numbers.
        local: Standard deviation of the local changes.

    Raises:
        ConfigError: If anny is not installed, or its hands have another topology.
    """
    model = _anny().create_hand_model(side="R", local_changes="all", triangulate_faces=True)
    return _drawn(model, like, count, seed, HAND_TARGETS, local)


def _anny() -> Any:
    try:
        return import_module("anny")
    except ImportError as error:
        raise ConfigError(
            f"the modes are made from the bodies of anny ({error}); install it: pip install anny"
        ) from None


def _drawn(
    model: Any, like: SkinnedMesh, count: int, seed: int, targets: Sequence[str], local: float
) -> Bodies:
    torch = import_module("torch")
    distribution = import_module("anny.shape_distribution").SimpleShapeDistribution
    torch.manual_seed(seed)
    ages = torch.distributions.Uniform(
        *(torch.tensor(age, dtype=model.dtype) for age in (YOUNGEST, OLDEST))
    )
    _, phenotypes = distribution(model, morphological_age_distribution=ages).sample(count)
    changes = _changes(model.local_change_labels, count, seed, targets, local)
    vertices, rests = [], []
    for first in range(0, count, BATCH):
        own = slice(first, first + BATCH)
        with torch.no_grad():
            made = model(
                phenotype_kwargs={name: values[own] for name, values in phenotypes.items()},
                local_changes_kwargs={
                    name: torch.tensor(values[own], dtype=model.dtype)
                    for name, values in changes.items()
                },
            )
        vertices.append(made["rest_vertices"].numpy())
        rests.append(made["rest_bone_poses"].numpy())
    points, poses = np.concatenate(vertices), np.concatenate(rests)
    if points.shape[1:] != like.vertices.shape or poses.shape[1] != len(like.labels):
        raise ConfigError(
            f"this version of anny has {points.shape[1]} vertices and {poses.shape[1]} bones; the "
            f"mesh has {len(like.vertices)} and {len(like.labels)}: install anny 0.6.2"
        )
    meshes = tuple(
        replace(like, vertices=own, rest=rest) for own, rest in zip(points, poses, strict=True)
    )
    return Bodies(meshes, {name: values.numpy() for name, values in phenotypes.items()})


def _changes(
    labels: Sequence[str], count: int, seed: int, targets: Sequence[str], local: float
) -> dict[str, Array]:
    """Returns values (N,) from -1 to 1 of the local changes, alike on the left and the right."""
    random = np.random.default_rng(seed)
    chosen = [
        label
        for label in labels
        if any(part in label for part in targets) and not any(part in label for part in LEFT_OUT)
    ]
    both = {name: name.removeprefix("l-").removeprefix("r-") for name in chosen}
    drawn = {
        name: np.clip(local * random.standard_normal(count), -1.0, 1.0)
        for name in sorted(set(both.values()))
    }
    return {name: drawn[side] for name, side in both.items()}
