"""The scenes that the page gets: shapes where the body is, points, marks and stored files."""

import json
from dataclasses import replace

import numpy as np
import pytest
from made_tracks import MadeRegistrar, made_scene, made_track

from regkit.geometry.camera import Camera
from regkit.geometry.rigid import exp, inverse, transformed
from regkit.geometry.rotation import to_matrix
from regkit.observation import Observation, PlacedCamera, View
from regkit.primitives import SPHERE, Volumes
from regkit.system.errors import DataError
from regkit.tracking.sample import MOST_FRAMES, MOST_POINTS, FrameSample
from regkit.viewer.model_shapes import SIGMAS, shapes_of, transforms_of
from regkit.viewer.packed import unpacked
from regkit.viewer.points import FramePoints, evenly
from regkit.viewer.recording_scene import recording_scene
from regkit.viewer.run_scene import run_scene
from regkit.viewer.scene import Scene
from regkit.viewer.track_file import read_scene, scene_arrays, write_scene
from regkit.viewer.track_scene import TrackScene
from regkit_plugins.shapes.gsog import GeneralizedSumOfGaussians
from regkit_plugins.shapes.mesh import Mesh
from regkit_plugins.shapes.sphere import SphereMesh
from regkit_plugins.templates.hand import Hand
from regkit_plugins.templates.human import Human

HUMAN, HAND = Human(height=1.7).body(1.7), Hand().body(0.19)


def document(scene: Scene) -> dict:
    return json.loads(scene.json())


def page_placed(transforms: np.ndarray, points: np.ndarray) -> np.ndarray:
    """The page's formula: points (K, ..., 3) moved by quaternions and origins (K, 7)."""
    rotations = to_matrix(transforms[:, :4].astype(float))
    moved = np.einsum("kij,k...j->k...i", rotations, points.astype(float))
    return moved + transforms[:, 4:].reshape(len(points), *(1,) * (points.ndim - 2), 3)


@pytest.mark.parametrize("body", [HUMAN, HAND], ids=["human", "hand"])
@pytest.mark.parametrize(
    "model", [GeneralizedSumOfGaussians(), SphereMesh()], ids=["gsog", "sphere"]
)
def test_page_places_primitives_where_the_model_has_them(body, model):
    primitives = model.bind(body)
    track = made_track(body, 3)
    scene = recording_scene("r", {"m": made_scene(body, primitives, 3)}, {"m": "#000000"}, 3)
    (method,) = document(Scene("t", (scene,)))["recordings"][0]["methods"]
    shape = {name: unpacked(one) for name, one in method["shapes"][0].items() if name != "kind"}
    for frame, transforms in enumerate(unpacked(method["transforms"])):
        placed = primitives.place(body.place(track.pose(frame)).transforms)
        carriers = transforms[shape["segments"]]
        if method["shapes"][0]["kind"] == "ellipsoids":
            found = page_placed(carriers, shape["centres"])
            np.testing.assert_allclose(shape["radii"], SIGMAS * primitives.scales, rtol=1e-6)
        else:
            ends = page_placed(carriers, shape["ends"])
            found = ends.mean(axis=1)
            lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
            np.testing.assert_allclose(lengths, 2.0 * primitives.halves, atol=1e-6)
        np.testing.assert_allclose(found, placed.centres, atol=1e-5)
        at = unpacked(method["markers"]["positions"])[frame]
        np.testing.assert_allclose(at, track.markers[frame], atol=1e-5)


@pytest.mark.parametrize("body", [HUMAN, HAND], ids=["human", "hand"])
def test_skinned_mesh_is_that_of_the_body(body):
    pose = made_track(body, 2).pose(1)
    transforms = body.place(pose).transforms
    model, mesh = shapes_of(MadeRegistrar(body, GeneralizedSumOfGaussians().bind(body)))
    assert (model.kind, mesh.kind) == ("ellipsoids", "mesh")
    expected = body.surface.place(transforms)
    np.testing.assert_allclose(mesh.placed(transforms_of(transforms)), expected, atol=1e-6)
    (alone,) = shapes_of(MadeRegistrar(body, Mesh().bind(body)))
    assert alone.kind == "mesh"
    few = alone.dots(100)
    assert len(few.centres) <= 100
    nearest = np.linalg.norm(few.placed(transforms_of(transforms))[:, None] - expected, axis=2)
    assert nearest.min(axis=1).max() < 0.05 * body.size


def test_other_solids_are_shown_as_their_hulls():
    gaussians = GeneralizedSumOfGaussians().bind(HUMAN)
    names = ("segments", "centres", "axes", "scales", "weights")
    solids = Volumes(**{name: getattr(gaussians, name) for name in names})
    hull = shapes_of(MadeRegistrar(HUMAN, solids))[0]
    transforms = HUMAN.place(HUMAN.skeleton.rest()).transforms
    placed = solids.place(transforms)
    surface = placed.centres[:, None] + solids.surface_points() @ np.swapaxes(placed.axes, 1, 2)
    np.testing.assert_allclose(
        hull.placed(transforms_of(transforms)), surface.reshape(-1, 3), atol=1e-9
    )
    a, b, c = hull.vertices[hull.triangles].transpose(1, 0, 2)
    volume = np.einsum("ti,ti->", a, np.cross(b, c)) / 6.0
    exact = (4.0 / 3.0 * np.pi * np.prod(SIGMAS * solids.scales, axis=1)).sum()
    assert 0.9 * exact < volume < exact  # A hull of points is inside, and faces outward.
    assert len(hull.triangles) > len(SPHERE)


def test_scene_file_holds_the_scene(tmp_path):
    scene = made_scene(HUMAN, GeneralizedSumOfGaussians().bind(HUMAN), 20, lost=4)
    write_scene(scene, tmp_path)
    first = (tmp_path / "scene.npz").read_bytes()
    write_scene(scene, tmp_path)
    assert (tmp_path / "scene.npz").read_bytes() == first
    again = read_scene(tmp_path)
    before, after = scene_arrays(scene), scene_arrays(again)
    assert before.keys() == after.keys()
    for name, array in before.items():
        if array.dtype.kind == "U":
            assert list(array.ravel()) == list(after[name].ravel())
        else:
            np.testing.assert_allclose(array, after[name], atol=2e-6, err_msg=name)
    np.testing.assert_allclose(again.points.at(3), scene.points.at(3))


def test_scene_file_that_contradicts_itself_is_refused(tmp_path):
    scene = made_scene(HUMAN, GeneralizedSumOfGaussians().bind(HUMAN), 5)
    arrays = scene_arrays(scene)
    wrong = {
        "points_offsets": arrays["points_offsets"] + 1,
        "points_differences": arrays["points_differences"].astype(float),
        "transforms": np.full_like(arrays["transforms"], np.nan),
        "shape0_segments": arrays["shape0_segments"] + 99,
        "bones": arrays["bones"] + 999,
        "fps": np.array(-1.0),
        "verdicts": np.full_like(arrays["verdicts"], "?"),
        "curves": arrays["curves"][:, 1:],
        "shape0_kind": np.array("torus"),
    }
    for name, array in wrong.items():
        np.savez(tmp_path / "scene.npz", **(arrays | {name: array}))
        with pytest.raises(DataError, match=r"scene\.npz"):
            read_scene(tmp_path)


def test_recording_has_the_worst_frames_of_all_methods():
    one = made_scene(HUMAN, GeneralizedSumOfGaussians().bind(HUMAN), 200, kept=40)
    other = replace(one, marked={7: "worst"}, points=FramePoints.of({7: np.ones((4, 3))}))
    scene = recording_scene("walk", {"a": one, "b": other}, {"a": "#111111", "b": "#222222"}, 12)
    assert scene.marked == ((7, "worst of b"), (199, "worst of a"))
    assert len(scene.frames) == 12
    assert {7, 199} <= {*scene.frames.tolist()}
    assert np.diff(scene.frames).max() < 40
    at = scene.frames.tolist().index(7)
    np.testing.assert_allclose(scene.points.at(at), 1.0, atol=2e-3)
    data = document(Scene("t", (scene,)))["recordings"][0]
    assert data["length"] == 200
    assert [one["name"] for one in data["methods"]] == ["a", "b"]
    assert data["camera"]["width"] == 160
    shown = unpacked(data["methods"][1]["transforms"])
    np.testing.assert_allclose(shown[at], one.transforms[7], atol=1e-6)


def test_verdicts_and_confidence_are_in_the_document():
    track = made_scene(HUMAN, GeneralizedSumOfGaussians().bind(HUMAN), 10, lost=3)
    track = replace(track, supports=np.where(np.arange(15) == 2, np.nan, track.supports))
    scene = recording_scene("walk", {"m": track}, {"m": "#111111"}, 10)
    (method,) = document(Scene("t", (scene,)))["recordings"][0]["methods"]
    assert method["verdicts"] == [["found", 7], ["lost", 3]]
    confidence = unpacked(method["confidence"])
    assert confidence.shape == (10, 15)
    assert (confidence[:, 2] == 1.0).all()
    assert [one["name"] for one in method["curves"]] == [
        "inlier share", "surface distance", "joint error",
    ]  # fmt: skip
    assert unpacked(method["curves"][0]["values"])[-1] == pytest.approx(10.0)


def test_ellipsoids_hold_the_markers_with_their_covariance(tmp_path, random):
    track, dofs = made_track(HUMAN, 4), HUMAN.skeleton.dofs
    factor = 0.02 * random.normal(size=(4, dofs, dofs))
    covariances = factor @ factor.transpose(0, 2, 1)
    covariances[2] = np.nan
    track = replace(track, covariances=covariances)
    registrar = MadeRegistrar(HUMAN, GeneralizedSumOfGaussians().bind(HUMAN))
    points = {frame: np.ones((4, 3)) for frame in range(4)}
    scene = TrackScene.of(track, registrar, points, fps=30.0)
    write_scene(scene, tmp_path)
    found = read_scene(tmp_path).ellipsoids
    assert np.isnan(found[2]).all()
    known = track.marker_covariances(HUMAN)
    axes, halves = to_matrix(found[0, :, :4].astype(float)), found[0, :, 4:].astype(float)
    # In three dimensions, 90 % of a Gaussian are within 2.5 standard deviations.
    shapes = np.einsum("mij,mj,mkj->mik", axes, (halves / 2.5003) ** 2, axes)
    np.testing.assert_allclose(shapes, known[0], rtol=1e-3, atol=1e-7)
    shown = recording_scene("walk", {"m": scene}, {"m": "#111111"}, 4)
    (method,) = document(Scene("t", (shown,)))["recordings"][0]["methods"]
    assert unpacked(method["ellipsoids"]).shape == (4, len(HUMAN.markers.names), 7)


def test_cameras_are_stored_and_their_pictures_corners_are_where_they_see_them(tmp_path, random):
    lens = Camera(width=80, height=60, fx=70.0, fy=90.0, cx=41.0, cy=27.0)
    poses = exp(random.normal(size=(2, 6)))
    placed = (PlacedCamera("left", poses[0], lens), PlacedCamera("right", poses[1]))
    registrar = MadeRegistrar(HUMAN, GeneralizedSumOfGaussians().bind(HUMAN))
    points = {frame: np.ones((4, 3)) for frame in range(4)}
    scene = TrackScene.of(made_track(HUMAN, 4), registrar, points, fps=30.0, cameras=placed)
    write_scene(scene, tmp_path)
    found = read_scene(tmp_path).cameras
    assert [(one.name, one.camera) for one in found] == [("left", lens), ("right", None)]
    shown = recording_scene("walk", {"m": replace(scene, cameras=found)}, {"m": "#111111"}, 4)
    cameras = document(Scene("t", (shown,)))["recordings"][0]["cameras"]
    assert [one["name"] for one in cameras] == ["left", "right"]
    for one, pose in zip(cameras, poses, strict=True):
        np.testing.assert_allclose(one["place"], pose[:3, 3])
        seen = transformed(inverse(pose), np.array(one["corners"]))
        np.testing.assert_allclose(seen[:, 2], 1.0)
    pixels = lens.projected(transformed(inverse(poses[0]), np.array(cameras[0]["corners"])))
    borders = [[-0.5, -0.5], [79.5, -0.5], [79.5, 59.5], [-0.5, 59.5]]
    np.testing.assert_allclose(pixels, borders, atol=1e-9)


def test_sample_keeps_each_camera_once():
    sample = FrameSample()
    data = Observation(np.ones((3, 3)), np.ones(3), np.ones(3))
    for number, names in enumerate([("a",), ("a", "b"), ("b", "c")]):
        views = [View(name, exp(np.full(6, 0.1 * (ord(name) - 96))), data) for name in names]
        sample.add(number, Observation.of_views(views))
    assert list(sample.cameras) == ["a", "b", "c"]


def test_long_and_many_recordings_are_thinned_and_it_is_told():
    track = made_scene(HUMAN, GeneralizedSumOfGaussians().bind(HUMAN), 300)
    stored = {f"r{at}": {"m": lambda: track, "old": lambda: None} for at in range(80)}
    scene = run_scene("t", stored, {"m": "#111111", "old": "#222222"})
    assert len(scene.recordings) == 60
    assert {len(one.frames) for one in scene.recordings} == {4}
    for told in ("240 of 18000 frames", "60 of 80 recordings", "old on r0"):
        assert told in scene.note
    assert run_scene("t", {"r": {"old": lambda: None}}, {}) is None


def test_sample_is_bounded_and_evenly_spread():
    class Seen:
        camera = None
        views = ()

        def __init__(self, number: int) -> None:
            self.points = np.full((2000, 3), float(number))

    sample = FrameSample()
    for number in range(10_000):
        sample.add(number, Seen(number))
        assert len(sample.points) <= MOST_FRAMES
    frames = list(sample.points)
    assert len(frames) >= MOST_FRAMES // 2
    assert len({*np.diff(frames)}) == 1
    assert 10_000 - frames[-1] <= np.diff(frames)[0]
    assert all((points == number).all() for number, points in sample.points.items())
    assert max(map(len, sample.points.values())) <= MOST_POINTS


def test_points_are_kept_to_a_fraction_of_a_millimetre(random):
    clouds = {3: random.normal(size=(50, 3)), 9: np.zeros((0, 3)), 11: random.normal(size=(7, 3))}
    points = FramePoints.of(clouds)
    assert points.frames.tolist() == [3, 9, 11]
    for frame, cloud in points.by_frame().items():
        np.testing.assert_allclose(cloud, clouds[frame], atol=0.51 * points.step)
    assert [len(points.thinned(0.5).at(at)) for at in range(3)] == [25, 0, 3]
    assert len(points.thinned(0.0).positions) == 0


def test_evenly_chosen_frames_hold_those_that_are_marked():
    assert evenly(range(100), 5, [13]) == [0, 13, 34, 66, 99]
    assert evenly([1, 2], 5, [2]) == [1, 2]
    assert evenly(range(10), 2, [3, 4, 5]) == [3, 4]
