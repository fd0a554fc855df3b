"""The poses of cameras, found from the body that moves before them."""

import numpy as np
import pytest
from around import CAMERA, around, facing, view_of
from PIL import Image

from regkit.calibration.extrinsics import Extrinsics
from regkit.calibration.extrinsics.alignment import aligned
from regkit.calibration.extrinsics.motions import Motion
from regkit.calibration.extrinsics.refinement import Refinement
from regkit.geometry.rigid import exp, inverse, log, transformed
from regkit.interfaces import Method, Preprocessor
from regkit.observation import Frame
from regkit.recording import Cameras
from regkit.system.errors import NotFoundError
from regkit.tracking.given_frames import GivenFrames
from regkit_plugins.templates.human import Human

TEMPLATE = Human(height=1.7)
TURN = 0.9
AWAY = 2.3


def moved_markers(times, seed=0):
    """Markers that swing, each in its own way, while all walk about, (T, M, 3)."""
    random = np.random.default_rng(seed)
    rest, swing = random.normal(size=(2, 12, 3)) * [0.3, 0.7, 0.2]
    walk = np.stack([np.sin(1.3 * times), 0.05 * np.cos(2.0 * times), np.cos(0.7 * times)], axis=1)
    phase = random.uniform(0.0, 6.0, size=12)
    return rest + walk[:, None] + 0.4 * swing * np.sin(3.0 * times[:, None] + phase)[..., None]


@pytest.mark.parametrize("offset", [0.0, 0.05, -0.11])
def test_motions_are_aligned_in_space_and_time_despite_outliers(offset):
    T_reference_camera = exp(np.array([1.0, -0.3, 2.0, 0.2, 1.4, -0.3]))
    times = np.arange(60) / 30.0
    random = np.random.default_rng(1)
    reference = moved_markers(times) + 0.01 * random.normal(size=(60, 12, 3))
    there = moved_markers(times + offset) + 0.01 * random.normal(size=(60, 12, 3))
    there[:, :2] += 0.5  # Two limbs that the camera does not see.
    seen = transformed(inverse(T_reference_camera), there.reshape(-1, 3)).reshape(there.shape)
    ones = np.ones((60, 12))
    found = aligned(Motion(times, reference, ones), Motion(times, seen, ones), 30.0)
    assert found.offset == pytest.approx(offset, abs=0.008)
    error = log(inverse(T_reference_camera) @ found.transform)
    assert np.linalg.norm(error[:3]) < 0.02
    assert np.linalg.norm(error[3:]) < 0.01


def test_motions_without_common_times_are_not_aligned():
    times = np.arange(20) / 30.0
    ones = np.ones((20, 12))
    early = Motion(times, moved_markers(times), ones)
    late = Motion(times + 5.0, moved_markers(times), ones)
    assert aligned(early, late, 30.0) is None


def standing(body, count, seed=2, distance=1.7):
    """Poses of a body that stands about and moves its limbs, in units of its size away."""
    random = np.random.default_rng(seed)
    step = 0.12 * random.normal(size=(2, body.skeleton.dofs))
    step[:, :3] *= 1.5
    swings = [
        np.sin(0.5 * frame) * step[0] + np.cos(0.4 * frame) * step[1] for frame in range(count)
    ]
    start = facing(body, distance, turn=0.2)
    return [body.skeleton.limits.projected(body.skeleton.retract(start, swing)) for swing in swings]


def test_refinement_finds_a_displaced_camera():
    body = TEMPLATE.body(1.7)
    poses = standing(body, 6)
    preprocessor = Preprocessor.parse(
        {"kind": "points", "voxel": 0.05, "sigma": 0.015}, place="test", field="preprocessor"
    )
    # All frames have the same cameras, whatever the pose of the body.
    second = around(facing(body).root[:3, 3], TURN)
    frames = [
        preprocessor.observation(Frame.of_views([
            view_of(body, pose, np.eye(4), "a"), view_of(body, pose, second, "b")
        ]))
        for pose in poses
    ]  # fmt: skip
    off = exp(np.array([0.03, -0.02, 0.04, 0.02, -0.03, 0.02]))
    # The distance to the surface itself has no bias.
    registrar = Method.parse("spheres", place="test", field="method").bind(body)
    found = Refinement(registrar, frames, list(poses), {"a": np.eye(4), "b": off @ inverse(second)})
    found.run()
    assert found.rested
    np.testing.assert_array_equal(found.cameras["a"], np.eye(4))
    error = log(found.cameras["b"] @ second)
    assert np.linalg.norm(error[:3]) < 0.015
    assert np.degrees(np.linalg.norm(error[3:])) < 0.5
    assert np.linalg.eigvalsh(found.covariance).min() > 0.0


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A recording of two cameras without their poses, and the pose of the second."""
    root = tmp_path_factory.mktemp("two_cameras")
    body = TEMPLATE.body(1.7)
    # No picture cuts the body off, so that the large atlas of such bodies is not made.
    poses = standing(body, 8, distance=AWAY)
    T_world_b = around(facing(body, AWAY).root[:3, 3], TURN)
    for name, T_world_camera in (("a", np.eye(4)), ("b", T_world_b)):
        (root / name / "depth").mkdir(parents=True)
        (root / name / "sequence.yaml").write_text("fps: 10\n")
        (root / name / "camera.json").write_text(CAMERA.to_json())
        for frame, pose in enumerate(poses):
            depth = view_of(body, pose, T_world_camera).data.depth
            Image.fromarray(np.rint(1000.0 * depth).astype(np.uint16)).save(
                root / name / "depth" / f"{frame:06d}.png"
            )
    return root, T_world_b


def test_calibrate_writes_the_cameras_of_a_folder(folder, regkit):
    root, T_world_b = folder
    template = "{kind: human, height: 1.7}"
    options = ["--extrinsics", "--template", template, "--segmentation", "[]", "--frames", "4"]
    ended = regkit("calibrate", root, *options)
    assert ended.code == 0, ended.err
    assert f"written: {root / 'cameras.json'}" in ended.out
    found = Cameras.read(root).cameras
    np.testing.assert_array_equal(found["a"].pose, np.eye(4))
    error = log(inverse(T_world_b) @ found["b"].pose)
    assert np.linalg.norm(error[:3]) < 0.03
    assert np.degrees(np.linalg.norm(error[3:])) < 1.0


def test_calibrate_refuses_a_folder_without_cameras(tmp_path, regkit):
    (tmp_path / "a" / "depth").mkdir(parents=True)
    for options, words in ((["--extrinsics", "--out", "poses.json"], "cameras.json"),
                           (["--extrinsics"], "sequence.yaml"),
                           (["--extrinsics", "--recording", "a"], "--recording")):  # fmt: skip
        ended = regkit("calibrate", tmp_path, *options)
        assert ended.code == 1
        assert words in ended.err
    assert not (tmp_path / "cameras.json").exists()


def test_camera_that_sees_another_motion_is_refused():
    body = TEMPLATE.body(1.7)
    first = [view_of(body, pose, np.eye(4)).data for pose in standing(body, 6)]
    empty = [view_of(body, facing(body), np.eye(4)).data for _ in range(6)]
    far = [GivenFrames(name=name, fps=10.0, length=6, given=tuple(frames))
           for name, frames in (("a", first), ("b", empty))]  # fmt: skip
    settings = Extrinsics(
        template=TEMPLATE,
        segmentation=[],
        start={"kind": "stances"},
        preprocessor={"kind": "points", "voxel": 0.05, "sigma": 0.015},
    )
    times = {"a": np.arange(6) / 10.0, "b": 100.0 + np.arange(6) / 10.0}
    with pytest.raises(NotFoundError, match="camera 'b'"):
        settings.found({"a": far[0], "b": far[1]}, times)
