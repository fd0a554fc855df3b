"""Many views of one object: pairs are aligned, and a pose graph makes them one consistent set."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np
import scipy

from regkit.alignment.alignment import Alignment, align
from regkit.alignment.judgement import judged
from regkit.body.verdict import Verdict
from regkit.geometry.rigid import inverse
from regkit.interfaces import AlignmentStart, Method
from regkit.system.arrays import Array
from regkit.system.brief import Brief
from regkit.system.errors import ConfigError
from regkit.system.optional import load_library

EVERY_PAIR = 12
"""Greatest number of views of which every pair is aligned."""

NEIGHBOURS = 4
"""Number of following views with which each of more views is aligned, around the turntable."""

PRUNED = 0.25
"""Least weight of a pair in the graph, below which it contradicts the others; Open3D's default."""


@dataclass(frozen=True)
class AlignedPair(Brief):
    """Two views that were aligned.

    Attributes:
        source: Index of the source.
        target: Index of the target.
        found: Their alignment.
        kept: Whether it agrees with the others.
    """

    source: int
    target: int
    found: Alignment
    kept: bool


@dataclass(frozen=True)
class JointAlignment(Brief):
    """Views in one frame, that of the first view.

    Attributes:
        transforms: T_world_view of each view, (V, 4, 4); NaN for one that nothing links.
        pairs: The pairs that were aligned and not lost.
    """

    transforms: Array
    pairs: tuple[AlignedPair, ...]

    @property
    def linked(self) -> list[bool]:
        """Whether each view is linked to the first one."""
        return [bool(np.isfinite(one).all()) for one in self.transforms]


def align_all(
    views: Sequence[Array],
    method: Method,
    *,
    voxel: float | None = None,
    start: str | AlignmentStart = "auto",
    places: Sequence[str] = (),
    threads: int | None = None,
) -> JointAlignment:
    """Aligns views of one object, such as those of a turntable, in their order or any other.

    The pairs of most overlap link all views; the others are loop closures, which Open3D's pose
    graph may leave out (Choi, Zhou and Koltun, Robust Reconstruction of Indoor Scenes, 2015).

    Args:
        views: Points of each view, (N, 3) [m].
        method: The registration method.
        voxel: Voxel size for downsampling [m], as in ``align``.
        start: The start of each pair, as in ``align``.
        places: Names of the views in messages.
        threads: Number of threads.

    Raises:
        RegkitError: If there are fewer than two views, or a view cannot be aligned.
    """
    count = len(views)
    if count < 2:
        raise ConfigError(f"{count} views; at least two are needed", place="views")
    names = list(places) or [f"view {index}" for index in range(count)]
    found: dict[tuple[int, int], Alignment] = {}
    for i, j in _pairs(count):
        one = align(
            views[i], views[j], method,
            voxel=voxel, start=start, places=(names[i], names[j]), threads=threads,
        )  # fmt: skip
        if one.deformation is not None:
            raise ConfigError(
                "the method deforms clouds, and views of one object are aligned rigidly; choose a "
                "rigid method",
                place="method",
            )
        if judged(one)[0] is not Verdict.LOST:
            found[i, j] = one
    tree, begins = _tree(count, found)
    transforms, kept = _optimized(begins, found, tree)
    pairs = (AlignedPair(i, j, one, (i, j) in kept) for (i, j), one in found.items())
    return JointAlignment(transforms, tuple(pairs))


def _pairs(count: int) -> list[tuple[int, int]]:
    """Returns the pairs of views to align, the smaller index first."""
    if count <= EVERY_PAIR:
        return list(combinations(range(count), 2))
    near = {(i, (i + gap) % count) for i in range(count) for gap in range(1, NEIGHBOURS + 1)}
    return sorted({(min(pair), max(pair)) for pair in near})


def _both(found: Alignment) -> float:
    """Mean of the fractions of both clouds that lie on the other; less if it is doubtful."""
    overlap = 0.5 * (found.agreement.fitness + found.agreement.overlap)
    return overlap if judged(found)[0] is Verdict.FOUND else 0.1 * overlap


def _tree(
    count: int, found: dict[tuple[int, int], Alignment]
) -> tuple[set[tuple[int, int]], Array]:
    """Returns the pairs of most overlap that link the views, and T_world_view by them (V, 4, 4)."""
    costs = np.zeros((count, count))
    for (i, j), one in found.items():
        costs[i, j] = 1.0 / max(_both(one), 1e-6)
    rows, columns = scipy.sparse.csgraph.minimum_spanning_tree(costs).nonzero()
    tree = {(int(i), int(j)) for i, j in zip(rows, columns, strict=True)}
    transforms = np.full((count, 4, 4), np.nan)
    transforms[0] = np.eye(4)
    known, waiting = {0}, set(tree)
    while ready := [pair for pair in waiting if len(known & set(pair)) == 1]:
        for i, j in ready:
            # T_world_source = T_world_target T_target_source.
            if j in known:
                transforms[i] = transforms[j] @ found[i, j].transform
            else:
                transforms[j] = transforms[i] @ inverse(found[i, j].transform)
            known |= {i, j}
            waiting.discard((i, j))
    return tree, transforms


def _optimized(
    begins: Array, found: dict[tuple[int, int], Alignment], tree: set[tuple[int, int]]
) -> tuple[Array, set[tuple[int, int]]]:
    """Returns T_world_view (V, 4, 4) of the pose graph, and the pairs that it keeps."""
    library = load_library("open3d")
    registration = library.pipelines.registration
    linked = [index for index in range(len(begins)) if np.isfinite(begins[index]).all()]
    number = {view: node for node, view in enumerate(linked)}
    graph = registration.PoseGraph()
    for view in linked:
        graph.nodes.append(registration.PoseGraphNode(begins[view]))
    # Doubtful pairs are less exact, too; they are used only where nothing else links a view.
    sure = {pair for pair, one in found.items() if judged(one)[0] is Verdict.FOUND}
    used = [pair for pair in found if set(pair) <= set(number) and pair in sure | tree]
    for i, j in used:
        graph.edges.append(
            registration.PoseGraphEdge(
                number[i], number[j], found[i, j].transform, _information(found[i, j]),
                uncertain=(i, j) not in tree,
            )
        )  # fmt: skip
    distance = float(np.median([found[pair].agreement.distance for pair in used] or [1.0]))
    with library.utility.VerbosityContextManager(library.utility.VerbosityLevel.Error):
        registration.global_optimization(
            graph,
            registration.GlobalOptimizationLevenbergMarquardt(),
            registration.GlobalOptimizationConvergenceCriteria(),
            registration.GlobalOptimizationOption(
                max_correspondence_distance=distance,
                edge_prune_threshold=PRUNED,
                reference_node=0,
            ),
        )
    transforms = begins.copy()
    for view, node in number.items():
        transforms[view] = graph.nodes[node].pose
    transforms[linked] = inverse(transforms[0]) @ transforms[linked]
    kept = {(linked[e.source_node_id], linked[e.target_node_id]) for e in graph.edges}
    return transforms, kept


def _information(found: Alignment) -> Any:
    """Returns the information (6, 6) of the points that agree, rotation first, as Open3D has it.

    Source: Choi, Zhou and Koltun, 2015, eq. 5, for points on a sphere of their mean radius.
    """
    count = found.agreement.fitness * found.points[0]
    return count * np.diag([found.radius**2] * 3 + [1.0] * 3)
