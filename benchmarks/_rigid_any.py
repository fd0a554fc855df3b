"""Rigid alignment in any orientation: views of one object, a bunny with outliers, LiDAR scans."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from _rigid_pairs import Pair
from scipy.spatial.transform import Rotation

from regkit.alignment import align, read_transform
from regkit.cli.choices import method_named
from regkit.clouds import read_cloud, spacing, voxel_downsampled, voxel_for
from regkit.geometry.rigid import inverse, rigid, transformed
from regkit.system.arrays import Array
from regkit.system.errors import DependencyError, RegkitError
from regkit.system.optional import load_library

POINTS = 5000
ANGLES = (24, 48, 72, 96)
WITHIN_DEG, WITHIN_SIZE = 5.0, 0.05

Aligner = Callable[[Array, Array], Array]
"""Source and target to T_target_source (4, 4)."""


def thinned(points: Array) -> Array:
    """Returns about ``POINTS`` points, one in each voxel."""
    voxel = voxel_for(points, POINTS)
    return points if voxel is None else voxel_downsampled(points, voxel)


def regkit_auto(source: Array, target: Array) -> Array:
    """Aligns as ``regkit align`` does, with a start in any orientation."""
    return align(source, target, method_named("rigid")).transform


def open3d_features(source: Array, target: Array) -> Array:
    """Aligns by Open3D: features with RANSAC, then point-to-plane ICP, as in its tutorial.

    Of the voxels for 5,000, 1,250 and 550 points, those for 1,250 gave it the most successes on the
    dragon, in a third of the time of the first.
    """
    library = load_library("open3d")
    library.utility.set_verbosity_level(library.utility.VerbosityLevel.Error)
    source, target = thinned(source), thinned(target)
    voxel = 2.0 * max(voxel_for(cloud, 5000) or spacing(cloud) for cloud in (source, target))
    search, registration = (
        library.geometry.KDTreeSearchParamHybrid,
        library.pipelines.registration,
    )
    whole = [
        library.geometry.PointCloud(library.utility.Vector3dVector(one)) for one in (source, target)
    ]
    clouds, features = [], []
    for cloud in whole:
        few = cloud.voxel_down_sample(voxel)
        few.estimate_normals(search(radius=2.0 * voxel, max_nn=30))
        clouds.append(few)
        features.append(
            registration.compute_fpfh_feature(few, search(radius=5.0 * voxel, max_nn=100))
        )
    library.utility.random.seed(0)
    near = 1.5 * voxel
    rough = registration.registration_ransac_based_on_feature_matching(
        *clouds,
        *features,
        True,
        near,
        registration.TransformationEstimationPointToPoint(False),
        3,
        [
            registration.CorrespondenceCheckerBasedOnEdgeLength(0.9),
            registration.CorrespondenceCheckerBasedOnDistance(near),
        ],
        registration.RANSACConvergenceCriteria(100_000, 0.999),
    )
    whole[1].estimate_normals(search(radius=2.0 * voxel, max_nn=30))
    plane = registration.TransformationEstimationPointToPlane()
    fine = registration.registration_icp(*whole, near, rough.transformation, plane)
    return np.asarray(fine.transformation)


def kiss_matcher(source: Array, target: Array) -> Array:
    """Aligns by KISS-Matcher, then small_gicp's GICP."""
    found = align(
        source, target, method_named("{kind: small_gicp, distance: 0.05}"), start="kiss_matcher"
    )
    return found.transform


ALIGNERS: dict[str, Aligner] = {
    "regkit": regkit_auto,
    "open3d_features": open3d_features,
    "kiss_matcher": kiss_matcher,
}


def view_pairs(file: Path, angle: int) -> Iterator[Pair]:
    """Yields pairs of views so far apart [deg], each source turned at random, always the same.

    Args:
        file: Views ``view_024`` (N, 3) [m] and their ``T_world_view_024`` (4, 4).
        angle: Difference of the numbers in the names.
    """
    with np.load(file) as arrays:
        views = {int(name[5:]): arrays[name] for name in arrays if name.startswith("view_")}
        poses = {number: arrays[f"T_world_view_{number:03d}"] for number in views}
    for number in sorted(views):
        other = (number + angle) % 360
        if other not in views:
            continue
        random = np.random.default_rng([number, angle])
        source, target = (thinned(views[one].astype(float)) for one in (number, other))
        size = float(np.linalg.norm(np.ptp(source, axis=0)))
        turn = rigid(
            Rotation.random(random_state=int(random.integers(1 << 30))).as_matrix(),
            size * random.normal(size=3),
        )
        truth = inverse(poses[other]) @ poses[number] @ inverse(turn)
        yield Pair(transformed(turn, source), target, truth, size)


def counted(aligner: Aligner, pairs: list[Pair]) -> dict[str, Any]:
    """Returns successes, their number of pairs, and mean processor and wall seconds."""
    successes, processor, wall = 0, 0.0, 0.0
    for pair in pairs:
        begun, clock = time.process_time(), time.perf_counter()
        try:
            turn, shift = pair.errors(aligner(pair.source, pair.target))
        except DependencyError:
            raise
        except RegkitError:
            turn = shift = np.inf
        processor += time.process_time() - begun
        wall += time.perf_counter() - clock
        successes += bool(turn < WITHIN_DEG and shift < WITHIN_SIZE)
    return {
        "successes": successes,
        "of": len(pairs),
        "seconds": round(processor / len(pairs), 3),
        "wall_seconds": round(wall / len(pairs), 3),
    }


def tables(name: str, columns: dict[str, list[Pair]]) -> dict[str, dict[str, Any]]:
    """Prints successes and seconds of all aligners, and returns them."""
    print(f"\n| {name} | {' | '.join(columns)} | processor seconds |")
    print("|---|" + "--:|" * (len(columns) + 1))
    figures: dict[str, dict[str, Any]] = {}
    first = next(iter(columns.values()))[0]
    for who, aligner in ALIGNERS.items():
        try:
            # The first call compiles, and loads what it needs.
            aligner(first.source, first.target)
        except DependencyError as error:
            print(f"| {who} | {error} |")
            continue
        except RegkitError:
            pass
        rows = {column: counted(aligner, pairs) for column, pairs in columns.items() if pairs}
        cells = [f"{row['successes']} of {row['of']}" for row in rows.values()]
        cells.append(" / ".join(f"{row['seconds']:.2f}" for row in rows.values()))
        print(f"| {who} | {' | '.join(cells)} |", flush=True)
        figures[who] = rows
    return figures


def views(file: Path) -> dict[str, dict[str, Any]]:
    """Prints the table of views of one object, and returns its figures."""
    columns = {str(angle): list(view_pairs(file, angle)) for angle in ANGLES}
    return tables(f"{file.parent.name}, degrees apart", {a: p for a, p in columns.items() if p})


def bunny_mesh(points: Array) -> Any:
    """Returns a mesh through the points of the bunny (N, 3), by Poisson's equation in Open3D."""
    library = load_library("open3d")
    cloud = library.geometry.PointCloud(library.utility.Vector3dVector(points))
    cloud.estimate_normals(library.geometry.KDTreeSearchParamKNN(10))
    cloud.orient_normals_consistent_tangent_plane(10)
    mesh, density = library.geometry.TriangleMesh.create_from_point_cloud_poisson(cloud, depth=6)
    mesh.remove_vertices_by_mask(np.asarray(density) < np.quantile(np.asarray(density), 0.02))
    return mesh


def bunny_pair(mesh: Any, count: int, angle: float, seed: int) -> Pair:
    """Returns a pair sampled apart: 60 % overlap, 25 % of ``count`` points spread over the box."""
    library = load_library("open3d")
    random = np.random.default_rng([seed, count, int(angle)])
    library.utility.random.seed(seed)
    whole = np.asarray(mesh.sample_points_uniformly(5000).points)
    size = float(np.linalg.norm(np.ptp(whole, axis=0)))
    axis, shift, cut = random.normal(size=(3, 3))
    rotation = Rotation.from_rotvec(np.radians(angle) * axis / np.linalg.norm(axis)).as_matrix()
    centre = whole.mean(axis=0)
    truth = rigid(rotation, centre + 0.1 * size * shift / np.linalg.norm(shift) - rotation @ centre)
    bounds = np.quantile(whole @ cut, [1.0 / 1.4, 1.0 - 1.0 / 1.4])
    clouds = []
    for which in range(2):
        library.utility.random.seed(1000 + 2 * seed + which)
        points = np.asarray(mesh.sample_points_uniformly(2 * count).points)
        along = points @ cut
        points = points[along <= bounds[0] if which == 0 else along >= bounds[1]]
        good = round(0.75 * count)
        points = random.permutation(points)[:good]
        if which:
            points = transformed(truth, points)
        low, high = points.min(axis=0), points.max(axis=0)
        spread = 0.1 * (high - low)
        stray = random.uniform(low - spread, high + spread, (count - good, 3))
        clouds.append(np.concatenate([points, stray]))
    return Pair(clouds[0], clouds[1], truth, size)


def bunnies(points: Array, seeds: int) -> dict[str, dict[str, Any]]:
    """Prints the table of the bunny at 10, 60, 90, 120 and 180 degrees, and returns its figures."""
    mesh = bunny_mesh(points)
    columns = {
        str(count): [
            bunny_pair(mesh, count, angle, seed)
            for angle in (10.0, 60.0, 90.0, 120.0, 180.0)
            for seed in range(seeds)
        ]
        for count in (450, 5000, 20_000, 35_000)
    }
    return tables("bunny, 60 % overlap, 25 % outliers, points", columns)


def turned_lidar(folder: Path, seeds: int) -> dict[str, dict[str, Any]]:
    """Prints the table of the LiDAR pair, the source turned about random axes."""
    clouds = [read_cloud(folder / f"{name}.ply") for name in ("source", "target")]
    truth = read_transform(str(folder / "T_target_source.txt"))
    columns: dict[str, list[Pair]] = {}
    for angle in (0, 60, 120, 180):
        columns[str(angle)] = []
        for seed in range(seeds):
            axis = np.random.default_rng(seed).normal(size=3)
            axis *= np.radians(angle) / np.linalg.norm(axis)
            turn = rigid(Rotation.from_rotvec(axis).as_matrix(), np.zeros(3))
            source = transformed(turn, clouds[0])
            # A success is within a metre, not within 5 % of the street.
            pair = Pair(source, clouds[1], truth @ inverse(turn), 20.0)
            columns[str(angle)].append(pair)
    return tables("LiDAR, turned by degrees", columns)
