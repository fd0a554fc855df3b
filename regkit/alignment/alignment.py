"""Alignment of a source cloud to a target cloud with any method that registers a rigid body."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from regkit.alignment.starts import initial_alignment
from regkit.alignment.uncertainty import alignment_covariance
from regkit.alignment.weak_motion import weak_motion
from regkit.body.cloud import cloud_body
from regkit.clouds import spacing, voxel_downsampled, voxel_for
from regkit.clouds.agreement import Agreement, Agreements
from regkit.clouds.checks import check_shape, check_sizes
from regkit.geometry.rigid import transformed
from regkit.interfaces import Deformation, Method
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
        deformation: What moves the transformed source onto the target; None of a rigid method.
        agreement: Registration quality after the alignment.
        before: Registration quality of the initial alignment.
        start: Description of the initial alignment.
        voxel: Voxel size to which both clouds were downsampled [m]; None if they were not.
        points: Number of source points and target points that were aligned.
        hidden: Description of a motion of the source that is weakly constrained by its surface;
            None if all motions are constrained.
        seconds: Time for downsampling, initial alignment and registration [s].
        converged: Whether the method converged.
        message: Reason of termination.
        covariance: Covariance of the alignment's error, (6, 6), in [m] and [rad]: of a twist,
            linear first, in the target's axes about the centroid of the aligned source.
    """

    transform: Array
    deformation: Deformation | None
    agreement: Agreement
    before: Agreement
    start: str
    voxel: float | None
    points: tuple[int, int]
    hidden: str | None
    seconds: float
    converged: bool
    message: str
    covariance: Array

    @property
    def deviations(self) -> Array:
        """Standard deviations of the source's centroid [m] and rotation [rad], (6,)."""
        return np.asarray(np.sqrt(np.diag(self.covariance)))

    def moved(self, points: Array) -> Array:
        """Returns points of the source (N, 3) [m] in the target's frame, with the deformation."""
        return _moved_points(points, self.transform, self.deformation)


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
    clouds = source, target
    for cloud, place in zip(clouds, places, strict=True):
        check_shape(cloud, place=place)
    check_sizes(source, target)
    if voxel is not None and not 0.0 <= voxel < np.inf:
        raise ConfigError(
            f"a voxel of {voxel:g} m; it must be a length, or 0 for no downsampling", place="voxel"
        )
    begun = time.perf_counter()
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
    deformation = None if found.deformation is None else found.deformation.shifted(origin)
    seconds = time.perf_counter() - begun
    distance = MAX_DISTANCE * max(spacing(few), spacing(seen))
    agreements = Agreements.of(few, seen)
    agreement = agreements.after(transform, distance)
    if deformation is not None:
        moved = _moved_points(few, transform, deformation)
        agreement = Agreements.of(moved, seen).after(np.eye(4), distance)
    return Alignment(
        transform=transform,
        deformation=deformation,
        agreement=agreement,
        before=agreements.after(initial.transform, distance),
        start=initial.description,
        voxel=voxel or None,
        points=(len(few), len(seen)),
        hidden=weak_motion(few),
        seconds=seconds,
        converged=found.converged,
        message=found.message,
        covariance=alignment_covariance(few, agreements.target, transform, agreement),
    )


def _moved_points(points: Array, transform: Array, deformation: Deformation | None) -> Array:
    """Returns points (N, 3) [m] transformed, and deformed if there is a deformation."""
    placed = transformed(transform, points)
    return placed if deformation is None else deformation.moved(placed)


def _moved(transform: Array, origin: Array, centre: Array) -> Array:
    """Returns T (4, 4) with a shift by ``centre`` (3,) [m] before it and ``origin`` (3,) after."""
    moved = transform.copy()
    moved[:3, 3] = transform[:3, 3] + (transform[:3, :3] @ centre + origin)
    return moved
