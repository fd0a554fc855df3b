"""Alignment of a source cloud to a target cloud with any method that registers a rigid body."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from regkit.alignment.contest import Contestant, Rival, ranked, rivals_of, worthwhile
from regkit.alignment.overlapping import evaluated, registered, registered_whole
from regkit.alignment.starts import candidates_of
from regkit.alignment.uncertainty import alignment_covariance
from regkit.alignment.weak_motion import weak_motion
from regkit.clouds import spacing, voxel_downsampled, voxel_for, without_stray
from regkit.clouds.agreement import Agreement, Agreements
from regkit.clouds.checks import check_shape, check_sizes
from regkit.geometry.rigid import transformed
from regkit.interfaces import AlignmentStart, Deformation, Method
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


MIN_CONSTRAINING = 50
"""Least number of points that tell which motions a surface constrains."""


@dataclass(frozen=True)
class Alignment(Brief):
    """The result of an alignment.

    Attributes:
        transform: T_target_source, (4, 4).
        deformation: What moves the transformed source onto the target; None of a rigid method.
        displacement: Mean and largest displacement of the aligned points by the deformation [m];
            None of a rigid method.
        agreement: Registration quality after the alignment.
        before: Registration quality of the initial alignment.
        start: Description of the initial alignment.
        voxel: Voxel size to which both clouds were downsampled [m]; None if they were not.
        points: Number of source points and target points that were aligned.
        radius: Radius of gyration of the source [m].
        stray: Fraction of the source's and of the target's points that were left out as stray.
        hidden: Description of a motion of the source that is weakly constrained by the surface
            that lies on the target; None if all motions are constrained.
        rivals: Other transforms that explain the clouds nearly as well.
        seconds: Time for downsampling, initial alignment and registration [s].
        converged: Whether the method converged.
        message: Reason of termination.
        covariance: Covariance of the alignment's error, (6, 6), in [m] and [rad]: of a twist,
            linear first, in the target's axes about the centroid of the aligned source.
    """

    transform: Array
    deformation: Deformation | None
    displacement: tuple[float, float] | None
    agreement: Agreement
    before: Agreement
    start: str
    voxel: float | None
    points: tuple[int, int]
    radius: float
    stray: tuple[float, float]
    hidden: str | None
    rivals: tuple[Rival, ...]
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
        placed = transformed(self.transform, points)
        return placed if self.deformation is None else self.deformation.moved(placed)


def align(
    source: Array,
    target: Array,
    method: Method,
    *,
    voxel: float | None = None,
    start: str | AlignmentStart = "auto",
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
        start: The start, see ``candidates_of``.
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
    start: str | AlignmentStart,
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
    candidates = worthwhile(candidates_of(start, few, seen, method))
    distance = MAX_DISTANCE * max(spacing(few), spacing(seen))
    agreements = Agreements.of(few, seen)
    contestants = []
    for candidate in candidates:
        transform, result = registered(candidate, agreements, method)
        # Energies of different parts of the clouds cannot be compared.
        alone = len(candidates) == 1
        energy = result.energy if alone else evaluated(transform, agreements, method).energy
        quality = agreements.after(transform, distance)
        contestants.append(Contestant(candidate, result, transform, quality, energy))
    order = ranked(contestants)
    best = order[0]
    if best.result.deformation is not None:
        best = registered_whole(best, agreements, method)
    deformation, agreement, displacement = best.result.deformation, best.agreement, None
    if deformation is not None:
        posed = transformed(best.transform, few)
        moved = deformation.moved(posed)
        agreement = Agreements.of(moved, seen).after(np.eye(4), distance)
        sizes = np.linalg.norm(moved - posed, axis=1)
        displacement = float(sizes.mean()), float(sizes.max())
    seconds = time.perf_counter() - begun
    return Alignment(
        transform=best.transform,
        deformation=deformation,
        displacement=displacement,
        agreement=agreement,
        before=agreements.after(best.candidate.transform, distance),
        start=best.candidate.description,
        voxel=voxel or None,
        points=(len(few), len(seen)),
        radius=float(np.sqrt(few.var(axis=0).sum())),
        stray=(1.0 - len(clouds[0]) / given[0], 1.0 - len(clouds[1]) / given[1]),
        hidden=_hidden(agreements, best, distance),
        rivals=rivals_of(order, agreements),
        seconds=seconds,
        converged=best.result.converged,
        message=best.result.message,
        covariance=alignment_covariance(few, agreements.target, best.transform, agreement),
    )


def _hidden(agreements: Agreements, best: Contestant, distance: float) -> str | None:
    """Returns the weak motion of what lies on the target, or of the whole source if that is little.

    Args:
        agreements: The clouds.
        best: The result.
        distance: Distance within which a point lies on the target [m].
    """
    source = agreements.source.points
    moved = transformed(best.transform, source)
    on = np.isfinite(agreements.target.nearest(moved, 1, distance)[0][:, 0])
    return weak_motion(source[on] if on.sum() >= MIN_CONSTRAINING else source)
