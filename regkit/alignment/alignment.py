"""Alignment of a source cloud to a target cloud with any method that registers a rigid body."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from regkit.alignment.starts import initial_alignment
from regkit.alignment.weak_motion import weak_motion
from regkit.body.cloud import cloud_body
from regkit.clouds import spacing, voxel_downsampled, voxel_for, without_stray
from regkit.clouds.agreement import Agreement, Agreements
from regkit.clouds.checks import check_shape, check_sizes
from regkit.interfaces import Method
from regkit.observation import Observation
from regkit.system.arrays import Array
from regkit.system.brief import Brief
from regkit.system.errors import ConfigError, DataError
from regkit.system.optional import one_blas_thread
from regkit.system.threads import each, using_threads

POINTS = 5000
"""Approximate number of points to which clouds are downsampled by default."""

MAX_DISTANCE = 1.5
"""Maximum correspondence distance, in units of the point spacing."""

MIN_POINTS = 10
"""Minimum number of points of each cloud after downsampling."""


@dataclass(frozen=True)
class Alignment(Brief):
    """The result of an alignment.

    Attributes:
        transform: T_target_source, (4, 4).
        agreement: Registration quality after the alignment.
        before: Registration quality of the initial alignment.
        start: Description of the initial alignment.
        voxel: Voxel size to which both clouds were downsampled [m]; None if they were not.
        points: Number of source points and target points that were aligned.
        stray: Fraction of the source's and of the target's points that were left out as stray.
        hidden: Description of a motion of the source that is weakly constrained by its surface;
            None if all motions are constrained.
        seconds: Time for downsampling, initial alignment and registration [s].
        converged: Whether the method converged.
        message: Reason of termination.
    """

    transform: Array
    agreement: Agreement
    before: Agreement
    start: str
    voxel: float | None
    points: tuple[int, int]
    stray: tuple[float, float]
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
    threads: int | None = None,
) -> Alignment:
    """Estimates T_target_source of two clouds.

    Args:
        source: Points to align, (N, 3) [m].
        target: Fixed points, (M, 3) [m].
        method: The registration method.
        voxel: Voxel size for downsampling both clouds [m]; by default about ``POINTS`` points
            remain, and 0 disables downsampling.
        start: Initial alignment, see ``initial_alignment``.
        places: Names of source and target in error messages.
        threads: Number of threads, by default one, or what the method says. The result is the same
            to the last bit.

    Raises:
        RegkitError: If the clouds cannot be aligned, the start is invalid, or the method fails.
    """
    with one_blas_thread(), using_threads(threads):
        return _aligned(source, target, method, voxel, start, places)


def _aligned(
    source: Array,
    target: Array,
    method: Method,
    voxel: float | None,
    start: str,
    places: tuple[str, str],
) -> Alignment:
    """Returns the alignment on the current threads."""
    clouds: tuple[Array, ...] = source, target
    for cloud, place in zip(clouds, places, strict=True):
        check_shape(cloud, place=place)
    check_sizes(source, target)
    if voxel is not None and not 0.0 <= voxel < np.inf:
        raise ConfigError(
            f"a voxel of {voxel:g} m; it must be a length, or 0 for no downsampling", place="voxel"
        )
    begun, given = time.perf_counter(), (len(source), len(target))
    if voxel != 0.0:
        clouds = tuple(each(without_stray, clouds))
    if voxel is None:
        voxel = max(voxel_for(cloud, POINTS) or 0.0 for cloud in clouds)
    few, seen = each(lambda cloud: voxel_downsampled(cloud, voxel) if voxel else cloud, clouds)
    if min(len(few), len(seen)) < MIN_POINTS:
        raise DataError(
            f"downsampling to voxels of {voxel:g} m leaves {len(few)} points of the source and "
            f"{len(seen)} of the target; at least {MIN_POINTS} are needed, choose a smaller "
            "voxel",
            place="voxel",
        )
    initial = initial_alignment(start, few, seen, method)
    # With the origin at the centroids, rotation and translation are decoupled, and numbers are
    # small: coordinates of maps, of millions of metres, would cost half of their digits.
    centre, origin = few.mean(axis=0), seen.mean(axis=0)
    body = cloud_body("source", few - centre)
    observation = Observation(
        seen - origin, np.ones(len(seen)), np.full(len(seen), spacing(seen) ** 2)
    )
    begin = _moved(initial.transform, -origin, centre)
    found = method.bind(body).register(observation, [body.skeleton.rest(begin)])
    transform = _moved(found.pose.root, origin, -centre)
    seconds = time.perf_counter() - begun
    distance = MAX_DISTANCE * max(spacing(few), spacing(seen))
    agreements = Agreements.of(few, seen)
    return Alignment(
        transform=transform,
        agreement=agreements.after(transform, distance),
        before=agreements.after(initial.transform, distance),
        start=initial.description,
        voxel=voxel or None,
        points=(len(few), len(seen)),
        stray=(1.0 - len(clouds[0]) / given[0], 1.0 - len(clouds[1]) / given[1]),
        hidden=weak_motion(few),
        seconds=seconds,
        converged=found.converged,
        message=found.message,
    )


def _moved(transform: Array, origin: Array, centre: Array) -> Array:
    """Returns T (4, 4) with a shift by ``centre`` (3,) [m] before it and ``origin`` (3,) after."""
    moved = transform.copy()
    moved[:3, 3] = transform[:3, 3] + (transform[:3, :3] @ centre + origin)
    return moved
