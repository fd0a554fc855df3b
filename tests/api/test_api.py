import io
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from places import DATA
from rich.console import Console

import regkit
from regkit.api.frame import frame_of
from regkit.interfaces import Method
from regkit.skeleton import Pose
from regkit.system.errors import ConfigError, DataError, RegkitError
from regkit.system.notes import RegkitWarning

WALK = DATA / "human_walk"
FRAMES = 4
HEIGHT = 1.63
START = {"kind": "given", "root": {"position": [-0.05, -0.05, 3.25], "rotation_deg": [180, 0, 0]}}
"""A pose near the first one, which takes less time than to find one."""


@pytest.fixture(scope="module")
def walk():
    return regkit.load_recording(WALK, frames=FRAMES)


@pytest.fixture(scope="module")
def human():
    return regkit.load_template("human", height=HEIGHT)


@pytest.fixture(scope="module")
def camera(walk):
    return next(walk.frames()).camera


@pytest.fixture(scope="module")
def depth(walk):
    return np.array([frame.depth for frame in walk.frames()])


@pytest.fixture(scope="module")
def tracking(walk, human):
    return regkit.track(walk, human, start=START)


def test_import_costs_nothing_and_names_are_there_when_asked_for():
    code = (
        "import regkit, sys; "
        "early = {'numpy', 'pydantic', 'open3d', 'regkit_plugins'} & set(sys.modules); "
        "assert not early, early; assert set(regkit.__all__) <= set(dir(regkit)); regkit.track; "
        "late = {'open3d', 'regkit_plugins', 'matplotlib'} & set(sys.modules); "
        "assert not late, late"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="no attribute 'trak'"):
        regkit.trak  # noqa: B018


def test_walk_is_tracked_within_two_centimetres(tracking, walk):
    assert tracking.error(walk.truth()) < 0.02
    assert tracking.markers.shape == (FRAMES, len(tracking.joint_names), 3)
    assert len(tracking.poses) == len(tracking) == FRAMES
    assert all(isinstance(pose, Pose) for pose in tracking.poses)


@pytest.mark.parametrize("form", ["images", "list", "matrix", "folder", "dataset"])
def test_frames_in_every_form_give_the_same_track(form, tracking, depth, camera, human):
    matrix = np.array([[camera.fx, 0, camera.cx], [0, camera.fy, camera.cy], [0, 0, 1]])
    lens = {"images": camera, "list": WALK / "camera.json", "matrix": matrix}.get(form)
    frames = {"images": depth, "list": list(depth), "matrix": depth.astype(np.float32)}.get(form)
    if form == "folder":
        frames = WALK
    elif form == "dataset":
        from regkit.interfaces import Dataset

        frames = Dataset.load("depth")(root=WALK, frames=FRAMES)
    found = regkit.track(frames, human, camera=lens, start=START)
    # A measurement in single precision is rounded by less than a micrometre.
    np.testing.assert_allclose(found.markers[:FRAMES], tracking.markers, atol=1e-4)


def test_methods_in_every_form_give_the_same_track(walk, human):
    mapping = {
        "kind": "direct",
        "shape": {"kind": "gsog", "surface": "visible"},
        "kernel": "likelihood",
        "solver": {"kind": "gauss_newton", "max_iterations": 6, "value_tolerance": 0.03},
        "tracker": "constant_velocity",
    }
    method = Method.load("direct").model_validate(mapping)
    forms = ({"preset": "best", "terms": []}, mapping, method)
    found = [regkit.track(walk, human, form, start=START).markers for form in forms]
    np.testing.assert_array_equal(found[0], found[1])
    np.testing.assert_array_equal(found[0], found[2])


def test_size_is_found_where_it_is_not_given(depth, camera):
    assert regkit.register(depth[0], "human", camera=camera).size == pytest.approx(HEIGHT, abs=0.05)


def test_cloud_seen_by_a_camera_is_registered_as_its_depth_image(depth, camera, human):
    image = regkit.register(depth[0], human, camera=camera, start=START)
    points = camera.back_projected(depth[0])
    cloud = regkit.register(points, human, camera=camera, start=START)
    assert np.linalg.norm(image.markers - cloud.markers, axis=1).mean() < 0.02
    assert cloud.markers.shape == (len(cloud.joint_names), 3)
    assert cloud.points.shape[1] == 3


def test_registration_from_its_own_pose_stays(depth, camera, human):
    first = regkit.register(depth[0], human, camera=camera)
    again = regkit.register(depth[0], human, camera=camera, start=first.pose)
    assert np.linalg.norm(again.markers - first.markers, axis=1).mean() < 0.005


def test_frame_of_a_track_is_a_registration(tracking):
    last = tracking[-1]
    np.testing.assert_array_equal(last.markers, tracking.markers[-1])
    np.testing.assert_array_equal(last.segments, tracking.segments[-1])
    with pytest.raises(IndexError):
        tracking[FRAMES]


@pytest.mark.parametrize("part", [slice(1, 3), slice(None), slice(-1, None), slice(None, None, 2)])
def test_slice_of_a_track_is_a_track(tracking, walk, part):
    some = tracking[part]
    indices = range(FRAMES)[part]
    assert len(some) == len(indices)
    np.testing.assert_array_equal(some.markers, tracking.markers[part])
    np.testing.assert_array_equal(some[0].markers, tracking[indices[0]].markers)
    np.testing.assert_array_equal(some[-1].points, tracking[indices[-1]].points)
    truth = walk.truth()
    errors = [tracking[at].error(dict(zip(truth.joints, truth.positions[at], strict=True)))
              for at in indices]  # fmt: skip
    assert some.error(truth) == pytest.approx(np.mean(errors), rel=0.05)
    assert str(indices[0]) in some[0].rows()["frame"]


def test_slice_without_a_frame_is_an_index_error(tracking):
    with pytest.raises(IndexError, match="of 4"):
        tracking[3:1]


def test_error_takes_the_truth_in_every_form(tracking, walk):
    truth = walk.truth()
    by_name = {name: truth.positions[:, at] for at, name in enumerate(truth.joints)}
    whole = np.full(tracking.markers.shape, np.nan)
    for name, positions in by_name.items():
        whole[:, tracking.joint_names.index(name)] = positions
    assert tracking.error(by_name) == pytest.approx(tracking.error(truth))
    assert tracking.error(whole) == pytest.approx(tracking.error(truth))
    assert tracking.error(tracking.markers) == 0.0
    assert 100 * tracking.error(truth) == pytest.approx(tracking.measure(truth).joint_error_raw_cm)
    assert tracking[0].error({"head": tracking.markers[0, 0] * 0 + 5}) > 1.0


def test_saved_motion_can_be_read(tracking, tmp_path):
    tracking.save(tmp_path / "walk.npz")
    with np.load(tmp_path / "walk.npz") as arrays:
        np.testing.assert_array_equal(arrays["markers"], tracking.markers)
        assert tuple(arrays["marker_names"]) == tracking.joint_names
        assert arrays["root"].shape == (FRAMES, 4, 4)
        assert float(arrays["size"]) == HEIGHT


def test_results_show_themselves(tracking):
    assert repr(tracking).startswith("<Tracking recording: human_walk, 4 frames; method: best;")
    assert "<td" in tracking._repr_html_()
    assert "human_walk" in tracking._repr_html_()
    console = Console(width=100, record=True, file=io.StringIO())
    console.print(tracking)
    console.print(tracking[0])
    told = console.export_text()
    assert "human, 1.63 m" in told
    assert "human_walk[0]" in told


def test_plot_is_a_figure_and_leaves_pyplot_alone(tracking, walk):
    from matplotlib.figure import Figure

    figure = tracking.plot(walk.truth())
    assert isinstance(figure, Figure)
    assert len(figure.axes) >= 4
    assert isinstance(tracking[0].plot(), Figure)
    assert "matplotlib.pyplot" not in sys.modules


def test_notebook_shows_a_figure_although_pyplot_is_not_imported(tracking):
    figure = tracking.plot()
    with Image.open(io.BytesIO(figure._repr_png_())) as picture:
        assert picture.size == tuple((figure.get_size_inches() * figure.dpi).astype(int))


def test_clouds_are_aligned_and_written(tmp_path):
    clouds = [DATA / "mannequin" / "clouds" / f"{number:06d}.npz" for number in (0, 3)]
    found = regkit.align(*clouds)
    assert found.fitness > 0.9
    with np.load(clouds[0]) as arrays:
        again = regkit.align(arrays["points"], clouds[1])
    np.testing.assert_array_equal(found.transform, again.transform)
    found.save(tmp_path / "aligned.npz")
    with np.load(tmp_path / "aligned.npz") as arrays:
        np.testing.assert_allclose(arrays["points"], found.aligned)
    assert len(found.plot().axes) == 4
    assert "96." in repr(found)


def _points(depth, camera):
    return camera.back_projected(depth[0])


WRONG = {
    "integers": (lambda d, c: (np.uint16(1000 * d), c), "frames[0]: numbers of type uint16"),
    "millimetres": (lambda d, c: (1000 * d, c), "frames[0]: the points are spread over"),
    "kilometres": (lambda d, c: (d / 1000, c), "give metres"),
    "no camera": (lambda d, c: (d, None), "camera: frames[0] of shape (144, 176)"),
    "camera of another size": (
        lambda d, c: (d[:, 1:], c),
        "frames[0]: the depth image has 176x143",
    ),
    "no matrix": (lambda d, c: (d, np.eye(2)), "camera: a camera must be"),
    "one image": (lambda d, c: (d[0], c), "frames: one array of shape"),
    "no depth": (lambda d, c: (np.full_like(d, np.nan), c), "frames: there is no measurement"),
    "no points": (lambda d, c: ([np.full((5, 3), np.nan)], None), "there is no measurement"),
    "negative": (lambda d, c: (d - 1.0, c), "frames[0]: 23191 depths are negative"),
    "far away": (lambda d, c: ([np.full((50, 3), 1e13)], None), "beyond 1e+12"),
    "K of fractions": (
        lambda d, c: (d, [[0.8, 0.0, 0.5], [0.0, 0.8, 0.5], [0.0, 0.0, 1.0]]),
        "camera: the focal length fx is 0.8 px",
    ),
    "K without its centre": (
        lambda d, c: (d, [[230.0, 0.0, 0.0], [0.0, 230.0, 0.0], [0.0, 0.0, 1.0]]),
        "camera: the principal point is the corner",
    ),
    "K with skew": (
        lambda d, c: (d, [[230.0, 1.0, 87.5], [0.0, 230.0, 71.5], [0.0, 0.0, 1.0]]),
        "skew",
    ),
    "text": (lambda d, c: ([[["a"]]], None), "frames[0]: values must be numbers"),
    "ragged": (lambda d, c: ([[[1.0], [2.0, 3.0]]], None), "its rows differ in length"),
    "four dimensions": (lambda d, c: (d[None], c), "frames[0]: an array of shape (4, 144, 176)"),
    "nothing": (lambda d, c: ([], c), "frames: there are no frames"),
    "empty": (lambda d, c: ([np.zeros((0, 3))], c), "there is no measurement"),
    "a number": (lambda d, c: (42, c), "frames: 42 is not"),
    "no folder": (lambda d, c: ("nowhere", None), "there is no such folder"),
    "folder and camera": (lambda d, c: (WALK, c), "camera: recordings and folders have a camera"),
    "matrix for a cloud": (lambda d, c: ([_points(d, c)], np.eye(3)), "camera: a matrix does not"),
}


@pytest.mark.filterwarnings("ignore::regkit.system.notes.RegkitWarning")
@pytest.mark.parametrize("wrong", WRONG)
def test_wrong_frames_are_named(wrong, depth, camera, human):
    make, message = WRONG[wrong]
    frames, lens = make(depth, camera)
    with pytest.raises(RegkitError) as caught:
        regkit.track(frames, human, camera=lens)
    assert message in str(caught.value)


def test_missing_measurements_leave_the_same_frame(depth, camera):
    """NaN, infinity, zero and a mask all mean that a pixel measured nothing."""
    image = depth[0]
    matrix = [[camera.fx, 0, camera.cx], [0, camera.fy, camera.cy], [0, 0, 1]]
    expected = camera.back_projected(image)
    for missing in (
        np.where(image > 0, image, np.nan),
        np.where(image > 0, image, np.inf),
        np.ma.masked_array(np.where(image > 0, image, 7.0), image == 0),
    ):
        for lens in (camera, matrix, np.array(matrix).T):
            frame = frame_of(missing, lens, place="cloud")
            np.testing.assert_array_equal(frame.points, expected)
            np.testing.assert_array_equal(frame.depth, image)
    with pytest.warns(RegkitWarning, match="cloud: 2 points are missing"):
        frame = frame_of([[1.0, 2, 3], [np.nan, 2, 3], [1, -np.inf, 3]], None, place="cloud")
    np.testing.assert_array_equal(frame.points, [[1.0, 2.0, 3.0]])


@pytest.mark.parametrize("scale", [0.0, -1.0, np.nan, np.inf])
def test_scale_of_an_image_is_positive(scale):
    with pytest.raises(RegkitError, match="depth_scale"):
        regkit.load_frame(WALK / "depth" / "000000.png", depth_scale=scale)


def test_wrong_choices_are_named(depth, camera, human):
    image = depth[0]
    cases = {
        "did you mean 'human'?": lambda: regkit.load_template("humann"),
        "load_template: template.heigt": lambda: regkit.load_template("human", heigt=1.7),
        "less than or equal to 2.5; it is 175": lambda: regkit.load_template("human", height=175),
        "nowhere.yaml: there is no such file": lambda: regkit.load_template("nowhere.yaml"),
        "did you mean 'best'?": lambda: regkit.register(image, human, "bst", camera=camera),
        "regkit.register: method.sape": lambda: regkit.register(
            image, human, {"preset": "best", "sape": "sog"}, camera=camera
        ),
        "start: a given start needs the template's size": lambda: regkit.register(
            image, "human", camera=camera, start={"kind": "given"}
        ),
        "start: a pose of another body: its balls are": lambda: regkit.register(
            image, human, camera=camera, start=Pose(np.eye(4), np.zeros((2, 4)), np.zeros(3))
        ),
        "start: a given start needs": lambda: regkit.register(
            image, "human", camera=camera, start=Pose(np.eye(4), np.zeros((2, 4)), np.zeros(3))
        ),
        "did you mean 'root'?": lambda: regkit.register(
            image, human, camera=camera, start={"kind": "given", "rot": {}}
        ),
        "regkit.align: method": lambda: regkit.align(np.ones((20, 3)), np.ones((20, 3)), "icpp"),
        "source: points have the shape": lambda: regkit.align(np.ones((20, 2)), np.ones((20, 3))),
    }
    for message, call in cases.items():
        with pytest.raises(RegkitError) as caught:
            call()
        assert message in str(caught.value)


def test_wrong_truth_and_file_are_named(tracking, tmp_path):
    with pytest.raises(DataError, match=r"truth: an array of shape \(3, 4\)"):
        tracking.error(np.zeros((3, 4)))
    with pytest.raises(DataError, match=r"truth\['head'\]: an array of shape \(2, 3\)"):
        tracking.error({"head": np.zeros((2, 3))})
    with pytest.raises(ConfigError, match=r"truth: none of its joints \(nose\) is a marker"):
        tracking.error({"nose": np.zeros((FRAMES, 3))})
    with pytest.raises(DataError, match="truth: it has 1 frames, but 4 were tracked"):
        tracking.plot(regkit.Truth(("head",), np.zeros((1, 1, 3))))
    with pytest.raises(DataError, match="no joint is visible"):
        tracking.error(np.full(tracking.markers.shape, np.nan))
    with pytest.raises(ConfigError, match=r"path: '.*walk.csv' must end with .npz"):
        tracking.save(tmp_path / "walk.csv")


def test_template_file_and_cloud_are_templates(tmp_path):
    file = Path(regkit.__file__).parents[1] / "plugins/regkit_plugins/templates/human.yaml"
    assert regkit.load_template(file, size=1.7).kind == "file"
    assert regkit.load_template(DATA / "mannequin" / "model.npz").kind == "cloud"
    assert regkit.load_template({"kind": "hand", "side": "left"}).side == "left"


def test_file_is_registered_as_its_frame(human, tmp_path):
    file = DATA / "human_walk" / "depth" / "000000.png"
    found = [
        regkit.register(one, human, start=START).markers
        for one in (file, str(file), regkit.load_frame(file))
    ]
    np.testing.assert_array_equal(found[0], found[1])
    np.testing.assert_array_equal(found[0], found[2])
    with pytest.raises(ConfigError, match=r"camera.json"):
        regkit.register(file, human, camera=np.eye(3))
    with pytest.raises(DataError, match="nowhere"):
        regkit.register(tmp_path / "nowhere.ply", human)
