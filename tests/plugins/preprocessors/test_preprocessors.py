"""Preprocessors: what of a frame they keep, and the Gaussians that they make of it."""

import numpy as np
import pytest
from messages import tells
from pydantic import ValidationError

from regkit.geometry.camera import Camera
from regkit.interfaces import Preprocessor
from regkit.observation import Frame
from regkit.observation.crop import Crop
from regkit.system.errors import DataError
from regkit_plugins.preprocessors.octree import OctreePreprocessor
from regkit_plugins.preprocessors.points import PointsPreprocessor

ANY = Crop(min_points=1)

OBSERVERS = [Preprocessor.load(kind)() for kind in Preprocessor.available()]


def frame(points, place: str | None = "some/000003.png") -> Frame:
    return Frame(np.asarray(points, dtype=float), place=place)


@pytest.fixture
def cloud(random) -> np.ndarray:
    """A dense ball at one side, a sparse one at the other, and strays."""
    dense = np.array([0.2, 0.1, 2.0]) + 0.1 * random.normal(size=(600, 3))
    sparse = np.array([-0.5, -0.3, 2.4]) + 0.3 * random.normal(size=(100, 3))
    strays = np.array([0.0, 0.0, 3.0]) + random.normal(size=(5, 3))
    return np.concatenate([dense, sparse, strays])


def test_points_without_voxels_are_kept_as_they_are(cloud):
    observation = PointsPreprocessor(sigma=0.03).preprocess(frame(cloud))
    np.testing.assert_array_equal(observation.points, cloud)
    np.testing.assert_array_equal(observation.weights, 1.0)
    np.testing.assert_allclose(observation.variances, 0.03**2, rtol=1e-15)


def test_points_of_a_voxel_become_their_mean(cloud):
    voxel = 0.05
    observation = PointsPreprocessor(voxel=voxel, sigma=0.01).preprocess(frame(cloud))
    groups: dict[tuple[int, ...], list[np.ndarray]] = {}
    for point in cloud:
        groups.setdefault(tuple(np.floor(point / voxel).astype(int)), []).append(point)
    expected = np.array(sorted(np.mean(group, axis=0).tolist() for group in groups.values()))
    found = np.array(sorted(observation.points.tolist()))
    np.testing.assert_allclose(found, expected, atol=1e-12)
    assert 1 < len(found) < len(cloud)
    np.testing.assert_array_equal(observation.weights, np.ones(len(found)))
    np.testing.assert_allclose(observation.variances, np.full(len(found), 0.01**2))


def test_points_larger_voxels_leave_fewer_points(cloud):
    counts = [
        len(PointsPreprocessor(voxel=voxel, crop=ANY).preprocess(frame(cloud)).points)
        for voxel in (0.01, 0.03, 0.1, 100.0)
    ]
    assert counts == sorted(counts, reverse=True)
    assert counts[0] > counts[-1]
    assert counts[-1] <= 8  # The planes through the origin may cut a cloud that lies across them.


@pytest.mark.parametrize(
    ("preprocessor", "field"),
    [(PointsPreprocessor(voxel=30), "voxel"), (OctreePreprocessor(leaf=45), "leaf")],
)
def test_millimetres_for_metres_are_told(cloud, preprocessor, field):
    shifted = cloud + 100.0  # The planes through the origin cut nothing here.
    with pytest.raises(
        DataError, match=rf"m is too large: .* 705 .*preprocessor\.{field}, in metres"
    ):
        preprocessor.preprocess(frame(shifted))


def test_crop_keeps_what_lies_between_near_and_far(cloud):
    kept = Crop(near=1.9, far=2.2).cropped(frame(cloud)).points
    z = cloud[:, 2]
    np.testing.assert_array_equal(kept, cloud[(z >= 1.9) & (z <= 2.2)])
    assert 0 < len(kept) < len(cloud)
    np.testing.assert_array_equal(Crop().cropped(frame(cloud)).points, cloud)


def test_crop_behind_nearest_drops_the_background_and_survives_a_stray(random):
    hand = np.array([0.0, 0.0, 0.5]) + 0.03 * random.uniform(-1.0, 1.0, size=(500, 3))
    owner = np.array([0.0, 0.0, 1.0]) + 0.1 * random.uniform(-1.0, 1.0, size=(500, 3))
    stray = [[0.0, 0.0, 0.05]]
    kept = Crop(behind_nearest=0.2).cropped(frame(np.concatenate([owner, hand, stray]))).points
    assert kept[:, 2].max() < 0.6
    assert len(kept) == len(hand) + 1


def test_crop_measures_the_nearest_after_the_near_limit(random):
    points = random.uniform(-0.5, 0.5, size=(400, 3)) + np.array([0.0, 0.0, 1.0])
    kept = Crop(near=0.9, behind_nearest=0.2).cropped(frame(points)).points
    assert kept[:, 2].min() >= 0.9
    assert 1.05 < kept[:, 2].max() < 1.15


@pytest.mark.parametrize(("near", "far"), [(2.0, 1.0), (1.0, 1.0)])
def test_crop_near_beyond_far_is_refused(near, far):
    with pytest.raises(ValidationError, match=rf"near \({near} m\) must be less than far"):
        Crop(near=near, far=far)


@pytest.mark.parametrize("preprocessor", OBSERVERS, ids=lambda preprocessor: preprocessor.kind)
class TestEveryObserver:
    def test_observation_does_not_depend_on_the_order_of_the_points(
        self, preprocessor, cloud, random
    ):
        def rows(points: np.ndarray) -> np.ndarray:
            seen = preprocessor.preprocess(frame(points))
            table = np.column_stack([seen.points, seen.weights, seen.variances])
            return table[np.lexsort(table.round(9).T)]

        np.testing.assert_allclose(rows(cloud), rows(random.permutation(cloud)), atol=1e-9)

    @pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
    def test_point_that_is_not_finite_is_refused(self, preprocessor, cloud, value):
        cloud[41, 1] = cloud[97, 2] = value
        with pytest.raises(DataError) as caught:
            preprocessor.preprocess(frame(cloud))
        assert str(caught.value).startswith(
            f"some/000003.png: 2 of {len(cloud)} points have a NaN or infinite coordinate, first "
            "at point 41: ["
        )

    def test_empty_frame_is_refused(self, preprocessor):
        with pytest.raises(DataError) as caught:
            preprocessor.preprocess(frame(np.zeros((0, 3))))
        assert tells(str(caught.value), at="some/000003.png", of=("empty", "no valid point"))

    def test_too_few_points_are_refused(self, preprocessor, cloud):
        with pytest.raises(DataError) as caught:
            preprocessor.preprocess(frame(cloud[:19]))
        words = ("19 of", "at least 20", "preprocessor.crop")
        assert tells(str(caught.value), at="some/000003.png", of=words)
        assert len(preprocessor.preprocess(frame(cloud[:20])).points)

    def test_crop_that_leaves_nothing_is_refused(self, preprocessor, cloud):
        cropped = preprocessor.model_validate(
            {
                "kind": preprocessor.kind,
                "crop": {"far": 0.1, "behind_nearest": 0.1, "min_points": 5},
            }
        )
        with pytest.raises(DataError, match=rf"0 of the frame's {len(cloud)} points are left"):
            cropped.preprocess(frame(cloud))

    def test_points_of_another_shape_are_refused(self, preprocessor):
        with pytest.raises(DataError, match=r"points have the shape \(30, 2\); they must be"):
            preprocessor.preprocess(frame(np.ones((30, 2))))


@pytest.mark.parametrize("largest", [0, 2, 6])
@pytest.mark.parametrize("few", [1, 2, 10])
def test_octree_keeps_the_number_and_the_mean_of_the_points(cloud, few, largest):
    """Each point is in one leaf, whose weight is the number of its points."""
    seen = OctreePreprocessor(leaf=0.05, few=few, largest=largest).preprocess(frame(cloud))
    assert seen.weights.sum() == len(cloud)
    np.testing.assert_array_equal(seen.weights, seen.weights.round())
    np.testing.assert_allclose(
        seen.weights @ seen.points / len(cloud), cloud.mean(axis=0), atol=1e-12
    )


def test_octree_sigma_is_half_the_side_of_a_cube_of_the_tree(cloud):
    leaf, largest = 0.05, 3
    seen = OctreePreprocessor(leaf=leaf, largest=largest).preprocess(frame(cloud))
    doublings = np.log2(2.0 * np.sqrt(seen.variances) / leaf)
    np.testing.assert_allclose(doublings, doublings.round(), atol=1e-9)
    assert set(doublings.round()) == {0.0, 1.0, 2.0, 3.0}


def test_octree_leaf_that_could_be_divided_holds_few_points(cloud):
    """And there are leaves of more points among the smallest, or the law would say nothing."""
    seen = OctreePreprocessor(leaf=0.05, few=3, largest=4).preprocess(frame(cloud))
    smallest = seen.variances == seen.variances.min()
    assert (seen.weights[~smallest] <= 3).all()
    assert (seen.weights[smallest] > 3).any()


def test_octree_leaves_are_cubes_that_hold_their_points(cloud):
    """Points are counted anew in the cube of each leaf, from the corner of the cloud."""
    leaf = 0.05
    seen = OctreePreprocessor(leaf=leaf, few=3, largest=2).preprocess(frame(cloud))
    corner = cloud.min(axis=0)
    for mean, weight, variance in zip(seen.points, seen.weights, seen.variances, strict=True):
        side = 2.0 * np.sqrt(variance)
        cube = np.floor((mean - corner) / side + 1e-9)
        inside = (np.floor((cloud - corner) / side) == cube).all(axis=1)
        assert inside.sum() == weight
        np.testing.assert_allclose(cloud[inside].mean(axis=0), mean, atol=1e-9)


def test_octree_coarser_leaves_are_fewer(cloud):
    counts = [
        len(OctreePreprocessor(leaf=leaf, largest=0, crop=ANY).preprocess(frame(cloud)).points)
        for leaf in (0.02, 0.04, 0.08, 0.16, 10.0)
    ]
    assert counts == sorted(counts, reverse=True)
    assert counts[0] > counts[1] > counts[-1] == 1


def test_octree_with_room_for_all_points_is_their_mean(cloud):
    preprocessor = OctreePreprocessor(leaf=1.0, few=len(cloud), largest=5, crop=ANY)
    seen = preprocessor.preprocess(frame(cloud))
    np.testing.assert_allclose(seen.points, [cloud.mean(axis=0)], atol=1e-12)
    np.testing.assert_array_equal(seen.variances, [(0.5 * 1.0 * 2**5) ** 2])


def test_what_is_cropped_is_cut_out_of_the_depth_image_too():
    """So that a background that was cut away counts as seen through."""
    camera = Camera(width=8, height=6, fx=10.0, fy=10.0, cx=3.5, cy=2.5)
    depth = np.full((6, 8), 3.0)
    depth[2:4, 2:5] = 1.0
    depth[0, 0] = 0.0
    whole = Frame(camera.back_projected(depth), camera, depth)
    cropped = Crop(far=2.0, min_points=1).cropped(whole)
    np.testing.assert_array_equal(cropped.depth, np.where(depth == 1.0, 1.0, 0.0))
    np.testing.assert_allclose(camera.back_projected(cropped.depth), cropped.points)
    observation = PointsPreprocessor(crop=Crop(far=2.0, min_points=1)).preprocess(whole)
    np.testing.assert_array_equal(observation.depth, cropped.depth)
