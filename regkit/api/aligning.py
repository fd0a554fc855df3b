"""Rigid alignment of two clouds."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from regkit.alignment import Alignment, judged
from regkit.alignment import align as align_clouds
from regkit.api.choices import Choice, name_of
from regkit.api.numbers import checked_numbers
from regkit.api.tables import Summary
from regkit.body.verdict import Verdict
from regkit.clouds import check_writable, read_cloud, write_cloud
from regkit.geometry.rigid import transformed
from regkit.interfaces import AlignmentStart, Method
from regkit.system.arrays import Array, without_missing

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from regkit.viewer.embedded import SceneView

Cloud = str | Path | ArrayLike
"""Points (N, 3) [m], or the file of a cloud or a mesh."""


@dataclass(frozen=True, repr=False)
class CloudAlignment(Summary):
    """A source aligned to a target.

    Attributes:
        source: Points (N, 3) [m] before the alignment.
        target: Points (M, 3) [m].
        method: Name of the method.
        found: The transform, the start, the agreement, and why the method ended.
    """

    source: Array
    target: Array
    method: str
    found: Alignment

    @property
    def transform(self) -> Array:
        """T_target_source, (4, 4) [m]."""
        return self.found.transform

    @property
    def aligned(self) -> Array:
        """Points of the source in the target's frame, (N, 3) [m], with the deformation, if any."""
        return self.found.moved(self.source)

    @property
    def displacements(self) -> Array | None:
        """Displacement (N, 3) [m] of each point by the deformation; None of a rigid method."""
        if self.found.deformation is None:
            return None
        return self.aligned - transformed(self.transform, self.source)

    @property
    def covariance(self) -> Array:
        """Covariance of the alignment's error, (6, 6), in [m] and [rad].

        It is that of a twist from the found to the true alignment, linear first: the centroid of
        the aligned source moves along the target's axes, and the source turns about them.
        """
        return self.found.covariance

    @property
    def fitness(self) -> float:
        """Fraction of the source's points that lie on the target, from 0 to 1."""
        return self.found.agreement.fitness

    @property
    def verdict(self) -> Verdict:
        """Whether the clouds were aligned: found, doubtful or lost."""
        return judged(self.found)[0]

    def plot(self) -> Figure:
        """Returns a figure of both clouds before and after, along two axes."""
        from regkit.report.alignment_figure import alignment_figure

        return alignment_figure(self.source, self.aligned, self.target)

    def view(self, *, height: int = 560) -> SceneView:
        """Returns a view of the target, the source and the aligned source, for a notebook.

        Args:
            height: Height in a notebook [px].
        """
        from regkit.viewer.alignment_scene import alignment_scene
        from regkit.viewer.embedded import SceneView

        scene = alignment_scene("alignment", self.source, self.target, self.aligned)
        return SceneView(scene, height)

    def save(self, path: str | Path) -> None:
        """Writes the aligned source as a cloud; the suffix of ``path`` selects the format.

        Raises:
            RegkitError: If the format is unknown, or the file cannot be written.
        """
        check_writable(Path(path), place="path")
        write_cloud(Path(path), self.aligned)

    def rows(self) -> dict[str, str]:
        """Returns the rows of a table: method, fitness, inlier RMSE, overlap and convergence."""
        fit, before = self.found.agreement, self.found.before
        rows = {
            "method": self.method,
            "fitness": f"{100 * fit.fitness:.1f} % of the source within {fit.distance:.3g} m "
            f"({100 * before.fitness:.1f} % at the start)",
            "inlier RMSE": f"{fit.inlier_rmse:.4g} m",
            "overlap": f"{100 * fit.overlap:.1f} % of the target",
            "start": self.found.start,
            **_deformed(self.displacements),
            "converged": f"{'yes' if self.found.converged else 'no'}: {self.found.message}",
        }
        if self.verdict is not Verdict.FOUND:
            rows[str(self.verdict)] = judged(self.found)[1]
        return rows


def _deformed(displacements: Array | None) -> dict[str, str]:
    """Returns the row of a deformation."""
    if displacements is None:
        return {}
    sizes = np.linalg.norm(displacements, axis=1)
    return {"deformation": f"{sizes.mean():.4g} m on average, at most {sizes.max():.4g} m"}


def align(
    source: Cloud,
    target: Cloud,
    method: Choice[Method] | None = None,
    *,
    voxel: float | None = None,
    start: Choice[AlignmentStart] = "auto",
    threads: int | None = None,
) -> CloudAlignment:
    """Aligns a rigid cloud to another, as ``regkit align`` does.

    Args:
        source: Points (N, 3) [m] to move, or the file of a cloud or a mesh.
        target: Points (M, 3) [m] that stay fixed, or a file.
        method: A preset such as ``"rigid"``, a kind such as ``"open3d_icp"`` or ``"small_gicp"``, a
            mapping such as ``{"kind": "open3d_icp", "estimation": "generalized"}``, or a method;
            by default regkit's own for rigid clouds.
        voxel: Voxel size [m] for downsampling both clouds; 0 turns downsampling off. By default
            about 5000 points are kept.
        start: ``"auto"`` for any orientation; a plug-in such as ``"features"``, ``"rotations"``,
            ``"open3d_features"`` or ``"kiss_matcher"``, by its name or as a mapping;
            ``"nearest"`` (the better of identity and centroids), ``"identity"``, ``"centroids"``,
            or a file with a 4x4 matrix.
        threads: Number of threads, for clouds of many points; by default one, or what the method
            says. The result is the same to the last bit.

    Returns:
        The alignment, with ``transform``, ``aligned`` and ``fitness``.

    Raises:
        RegkitError: If an argument is invalid, or the clouds cannot be aligned.
    """
    method = Method.default("rigid") if method is None else method
    chosen = Method.parse(method, place="regkit.align", field="method")
    clouds = [cloud_of(source, "source"), cloud_of(target, "target")]
    begin = start_of(start, place="regkit.align")
    found = align_clouds(clouds[0], clouds[1], chosen, voxel=voxel, start=begin, threads=threads)
    return CloudAlignment(clouds[0], clouds[1], name_of(method), found)


def start_of(start: Choice[AlignmentStart], *, place: str) -> str | AlignmentStart:
    """Returns a start by its name or file, or as a plug-in.

    Raises:
        RegkitError: If it is invalid.
    """
    if isinstance(start, (str, AlignmentStart)):
        return start
    if isinstance(start, Path):
        return str(start)
    return AlignmentStart.parse(start, place=place, field="start")


def cloud_of(given: Cloud, place: str) -> Array:
    """Returns the points (N, 3) [m] of a cloud.

    Raises:
        RegkitError: If it cannot be read, or is no cloud.
    """
    if isinstance(given, (str, Path)):
        return read_cloud(Path(given))
    return without_missing(checked_numbers(given, place=place, whole=True), place=place)
