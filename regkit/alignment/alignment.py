"""Aligning one cloud to another with any method that registers a rigid body."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from regkit.alignment.determined import hidden_motion
from regkit.alignment.starts import beginning
from regkit.body.cloud import cloud_body
from regkit.clouds import spacing, voxel_downsampled, voxel_for
from regkit.clouds.agreement import Agreement, agreement
from regkit.clouds.checks import check_shape, check_sizes
from regkit.geometry.rigid import rigid
from regkit.interfaces import Method
from regkit.observation import Observation
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit.system.optional import one_blas_thread

POINTS = 5000
"""Without a voxel, clouds are downsampled to about so many points."""

WITHIN = 1.5
"""A point agrees with a cloud within so many distances of its neighbouring points."""


@dataclass(frozen=True)
class Alignment:
    """What became of a source.

    Attributes:
        transform: T_target_source, (4, 4).
        agreement: How well the source lies on the target then.
        before: How well it did at the start.
        start: How the start was found.
        voxel: Side of the cubes to which both clouds were downsampled [m]; None if they were not.
        points: How many points of the source and of the target were compared.
        hidden: A motion of the source that its surface hardly shows, in words, if there is one.
        seconds: Time to thin, to find the start and to register.
        converged: Whether the method met a tolerance.
        message: Why it ended.
    """

    transform: Array
    agreement: Agreement
    before: Agreement
    start: str
    voxel: float | None
    points: tuple[int, int]
    hidden: str | None
    seconds: float
    converged: bool
    message: str


def align(
    source: Array,
    target: Array,
    method: Method,
    *,
    voxel: float | None = None,
    start: str = "nearest",
    places: tuple[str, str] = ("source", "target"),
) -> Alignment:
    """Find T_target_source of two clouds.

    Args:
        source: Points (N, 3) [m] to be moved.
        target: Points (M, 3) [m] that rest.
        method: What registers them.
        voxel: Side of the cubes to which both are downsampled [m]; 0 for not at all.
        start: Where to set out from, as ``beginning`` takes it.
        places: What source and target are called in messages.

    Raises:
        RegkitError: If the clouds cannot be aligned, the start is wrong, or the method fails.
    """
    for points, place in zip((source, target), places, strict=True):
        check_shape(points, place=place)
    check_sizes(source, target)
    with one_blas_thread():
        begun = time.perf_counter()
        if voxel is None:
            voxel = max((voxel_for(points, POINTS) or 0.0) for points in (source, target))
        few, seen = (voxel_downsampled(p, voxel) if voxel else p for p in (source, target))
        if min(len(few), len(seen)) < 10:
            raise DataError(
                f"{len(few)} points of the source and {len(seen)} of the target are left in "
                f"voxels of {voxel:g} m; choose smaller ones",
                place="voxel",
            )
        begin = beginning(start, few, seen, method)
        # About its own centre a body's rotation does not pull at its translation.
        centre = few.mean(axis=0)
        body = cloud_body("source", few - centre)
        observation = Observation(seen, np.ones(len(seen)), np.full(len(seen), spacing(seen) ** 2))
        pose = body.skeleton.rest(begin.transform @ rigid(np.eye(3), centre))
        found = method.bind(body).register(observation, [pose])
        transform = found.pose.root @ rigid(np.eye(3), -centre)
        seconds = time.perf_counter() - begun
    distance = WITHIN * max(spacing(few), spacing(seen))
    return Alignment(
        transform=transform,
        agreement=agreement(few, seen, transform, distance),
        before=agreement(few, seen, begin.transform, distance),
        start=begin.told,
        voxel=voxel or None,
        points=(len(few), len(seen)),
        hidden=hidden_motion(few),
        seconds=seconds,
        converged=found.converged,
        message=found.message,
    )
