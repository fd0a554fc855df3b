"""Rigid alignment of many views of one object."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from regkit.alignment import JointAlignment, judged_all
from regkit.alignment import align_all as align_clouds
from regkit.api.aligning import Cloud, cloud_of, start_of
from regkit.api.choices import Choice, name_of
from regkit.api.tables import Summary
from regkit.body.verdict import Verdict
from regkit.clouds import check_writable, write_cloud
from regkit.geometry.rigid import transformed
from regkit.interfaces import AlignmentStart, Method
from regkit.system.arrays import Array
from regkit.system.errors import DataError


@dataclass(frozen=True, repr=False)
class ViewsAlignment(Summary):
    """Views of one object in the frame of the first one.

    Attributes:
        views: Points of each view before the alignment, (N, 3) [m].
        names: Names of the views: their files, or "view 0" and so on.
        method: Name of the method.
        found: The transforms, and the pairs that were aligned.
    """

    views: tuple[Array, ...]
    names: tuple[str, ...]
    method: str
    found: JointAlignment

    @property
    def transforms(self) -> Array:
        """T_world_view of each view, (V, 4, 4) [m]; NaN for one that nothing links."""
        return self.found.transforms

    @property
    def verdict(self) -> Verdict:
        """Whether all views were aligned: found, doubtful or lost."""
        return judged_all(self.found, self.names)[0]

    @property
    def merged(self) -> Array:
        """All points in the frame of the first view, (N, 3) [m].

        Raises:
            DataError: If nothing links a view to the first one.
        """
        verdict, reason = judged_all(self.found, self.names)
        if verdict is Verdict.LOST:
            raise DataError(reason)
        placed = zip(self.transforms, self.views, strict=True)
        return np.concatenate([transformed(pose, view) for pose, view in placed])

    def save(self, path: str | Path) -> None:
        """Writes the merged views as a cloud; the suffix of ``path`` selects the format.

        Raises:
            RegkitError: If the format is unknown, the file cannot be written, or nothing links a
                view to the first one.
        """
        check_writable(Path(path), place="path")
        write_cloud(Path(path), self.merged)

    def rows(self) -> dict[str, str]:
        """Returns the rows of a table: method, views, pairs, and what is doubtful."""
        kept, pairs = sum(pair.kept for pair in self.found.pairs), len(self.found.pairs)
        rows = {
            "method": self.method,
            "views": f"{sum(self.found.linked)} of {len(self.views)} are linked to the first",
            "pairs": f"{kept} of {pairs} agree with one another",
        }
        verdict, reason = judged_all(self.found, self.names)
        return rows if verdict is Verdict.FOUND else rows | {str(verdict): reason}


def align_all(
    views: Sequence[Cloud],
    method: Choice[Method] | None = None,
    *,
    voxel: float | None = None,
    start: Choice[AlignmentStart] = "auto",
    threads: int | None = None,
) -> ViewsAlignment:
    """Aligns views of one object to one another, as ``regkit align --all`` does.

    Args:
        views: Points (N, 3) [m] of each view, or the files of clouds or meshes; at least two.
        method: As in ``align``.
        voxel: As in ``align``.
        start: As in ``align``, for each pair.
        threads: As in ``align``.

    Returns:
        The views in the frame of the first one, with ``transforms`` and ``merged``.

    Raises:
        RegkitError: If an argument is invalid, or a pair cannot be aligned.
    """
    method = Method.default("rigid") if method is None else method
    chosen = Method.parse(method, place="regkit.align_all", field="method")
    names = tuple(
        str(view) if isinstance(view, (str, Path)) else f"view {index}"
        for index, view in enumerate(views)
    )
    clouds = tuple(cloud_of(view, name) for view, name in zip(views, names, strict=True))
    begin = start_of(start, place="regkit.align_all")
    found = align_clouds(clouds, chosen, voxel=voxel, start=begin, places=names, threads=threads)
    return ViewsAlignment(clouds, names, name_of(method), found)
