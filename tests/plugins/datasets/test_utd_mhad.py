"""The layout of UTD-MHAD: what is read, and what is said of files that are wrong."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from damage import complaint, cut, everything, remove, write
from scipy.io import savemat
from scipy.spatial import KDTree

from regkit_plugins.datasets.utd_mhad import CAMERA, JOINTS, UtdMhad


def write_utd(root: Path, name: str = "a1_s1_t1", *, skeleton: bool = True) -> np.ndarray:
    """Two frames of a wall with one near block in the stored image's left half, and its joints."""
    (root / "Depth").mkdir(parents=True, exist_ok=True)
    (root / "Skeleton").mkdir(exist_ok=True)
    depth = np.zeros((240, 320, 2), dtype=np.uint16)
    depth[100:120, 60:80] = 2000
    savemat(root / "Depth" / f"{name}_depth.mat", {"d_depth": depth})
    joints = np.arange(20 * 3 * 2, dtype=float).reshape(20, 3, 2) / 100.0
    if skeleton:
        savemat(root / "Skeleton" / f"{name}_skeleton.mat", {"d_skel": joints})
    return joints


def test_utd_is_turned_round_as_a_whole(tmp_path):
    """What is stored on the left is on the right, for images and joints; y points down."""
    joints = write_utd(tmp_path)
    (found,) = UtdMhad(root=tmp_path).chosen()
    assert (found.name, found.length, found.fps) == ("a1_s1_t1", 2, 30.0)
    frame = next(found.frames())
    assert frame.camera == CAMERA
    assert len(frame.points) == 20 * 20
    np.testing.assert_array_equal(frame.points[:, 2], 2.0)
    pixels = CAMERA.projected(frame.points)
    assert (pixels[:, 0].min(), pixels[:, 0].max()) == pytest.approx((319 - 79, 319 - 60))
    assert (pixels[:, 1].min(), pixels[:, 1].max()) == pytest.approx((100, 119))
    truth = found.truth()
    assert truth.joints == JOINTS
    # The skeletons are one and a half frames ahead, so that both images have the first one.
    for index in range(2):
        np.testing.assert_allclose(truth.positions[index], joints[:, :, 0] * [-1, -1, 1])
    (plain,) = UtdMhad(root=tmp_path, skeleton_lead=0.0).chosen()
    (half,) = UtdMhad(root=tmp_path, skeleton_lead=0.5).chosen()
    stored = np.moveaxis(joints, 2, 0) * [-1, -1, 1]
    np.testing.assert_allclose(plain.truth().positions, stored)
    np.testing.assert_allclose(half.truth().positions[1], stored.mean(axis=0))


def test_utd_joints_of_moving_arms_fit_the_images_best_with_the_lead(utd):
    """Measured on the images alone: how far wrists and hands are from the nearest point."""
    arms = [JOINTS.index(name) for name in ("left_wrist", "left_hand", "right_wrist", "right_hand")]

    def gap(recording) -> float:
        distances = [
            KDTree(frame.points).query(joints[arms])[0].mean()
            for frame, joints in zip(recording.frames(), recording.truth().positions, strict=True)
        ]
        return float(np.mean(distances))

    for name in ("a7_s1_t1", "a9_s2_t1"):
        gaps = {
            lead: gap(UtdMhad(root=utd, recordings=(name,), skeleton_lead=lead).chosen()[0])
            for lead in (0.0, 1.5, 3.0)
        }
        assert gaps[1.5] < 0.85 * min(gaps[0.0], gaps[3.0])


def test_utd_joints_are_twenty_in_the_order_of_the_kinect():
    assert len(set(JOINTS)) == 20
    assert JOINTS[:4] == ("head", "neck", "spine", "pelvis")
    assert JOINTS[4:8] == ("left_shoulder", "left_elbow", "left_wrist", "left_hand")
    assert JOINTS[16:] == ("right_hip", "right_knee", "right_ankle", "right_foot")


def test_utd_recordings_are_sorted_by_number_and_cut(tmp_path):
    for name in ("a19_s1_t1", "a9_s1_t1", "a9_s10_t1", "a9_s2_t1"):
        write_utd(tmp_path, name)
    names = [found.name for found in UtdMhad(root=tmp_path).chosen()]
    assert names == ["a9_s1_t1", "a9_s2_t1", "a9_s10_t1", "a19_s1_t1"]
    (found,) = UtdMhad(root=tmp_path, recordings=("a9_s2_t1",), frames=1).chosen()
    assert found.length == len(list(found.frames())) == len(found.truth().positions) == 1


def test_utd_without_a_skeleton_has_no_truth(tmp_path):
    write_utd(tmp_path, skeleton=False)
    (found,) = UtdMhad(root=tmp_path).chosen()
    assert found.truth() is None


DEPTH, SKELETON = "Depth/a1_s1_t1_depth.mat", "Skeleton/a1_s1_t1_skeleton.mat"


def mat(name: str, **arrays) -> Callable[[Path], None]:
    return lambda folder: savemat(folder / name, arrays)


@pytest.mark.parametrize(
    ("damage", "expected"),
    [
        (remove("Depth"), "ROOT: no recording here: Depth/ must hold files like"),
        (remove(DEPTH), "ROOT: no recording here"),
        (mat(DEPTH, depth=np.ones((240, 320, 2))), f"ROOT/{DEPTH}: not a .mat file with 'd_depth'"),
        (mat(DEPTH, d_depth=np.ones((240, 320))), f"ROOT/{DEPTH}: d_depth has the shape"),
        (mat(DEPTH, d_depth=np.ones((320, 240, 2))), f"ROOT/{DEPTH}: frame 0: the depth image has "
         "240x320 pixels, but the camera has 320x240"),
        (cut(DEPTH, 0.5), f"ROOT/{DEPTH}: not a .mat file with 'd_depth'"),
        (cut(DEPTH, 0.0), f"ROOT/{DEPTH}: not a .mat file with 'd_depth'"),
        (write(DEPTH, "hello"), f"ROOT/{DEPTH}: not a .mat file with 'd_depth'"),
        (write(DEPTH, b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM" + bytes(200)),
         f"ROOT/{DEPTH}: not an HDF5 file, or damaged"),
        (mat(SKELETON, skel=np.ones((20, 3, 2))), f"ROOT/{SKELETON}: not a .mat file with "
         "'d_skel'"),
        (mat(SKELETON, d_skel=np.ones((15, 3, 2))), f"ROOT/{SKELETON}: d_skel has the shape "
         "(2, 15, 3), frames first; it must be (2, 20, 3)"),
        (mat(SKELETON, d_skel=np.ones((20, 3, 1))), f"ROOT/{SKELETON}: d_skel has the shape "),
        (mat(SKELETON, d_skel=np.ones((20, 3))), f"ROOT/{SKELETON}: d_skel has the shape (20, 3)"),
        (write(SKELETON, b""), f"ROOT/{SKELETON}: not a .mat file with 'd_skel'"),
    ],
)  # fmt: skip
def test_utd_that_is_wrong_is_told_with_its_place(tmp_path, damage, expected):
    write_utd(tmp_path)
    dataset = UtdMhad(root=tmp_path)
    assert len(everything(dataset)) == 2
    damage(tmp_path)
    assert complaint(dataset, tmp_path).startswith(expected)


@pytest.fixture(scope="session")
def utd(reference_data) -> Path:
    if not (reference_data / "utd_mhad").is_dir():
        pytest.skip("UTD-MHAD is not among the reference data")
    return reference_data / "utd_mhad"


def test_utd_reference_data_are_found_with_their_joints(utd):
    found = UtdMhad(root=utd).chosen()
    assert len(found) == len(list((utd / "Depth").iterdir())) == 14
    assert [recording.name for recording in found][:2] == ["a1_s1_t1", "a1_s2_t1"]
    for recording in found:
        assert recording.length > 30
        truth = recording.truth()
        assert len(truth.positions) == recording.length
        assert np.isfinite(truth.positions).all()


def test_utd_people_are_no_mirror_images(utd):
    """Facing the camera, a person's left is on the image's right, the head above the feet."""
    for recording in UtdMhad(root=utd).chosen():
        joints = dict(zip(JOINTS, np.moveaxis(recording.truth().positions, 1, 0), strict=True))
        assert (joints["left_shoulder"][:, 0] > joints["right_shoulder"][:, 0]).mean() > 0.9
        assert joints["head"][:, 1].mean() < joints["left_foot"][:, 1].mean()


def test_utd_joints_lie_near_the_cloud(utd):
    """Were only one of the two turned round, arms would be beside the body's points."""

    def gap(joints: np.ndarray, points: np.ndarray) -> float:
        return np.median(np.linalg.norm(joints[:, None] - points[None], axis=2).min(axis=1))

    gaps, mirrored = [], []
    for recording in UtdMhad(root=utd, frames=1).chosen():
        points = next(recording.frames()).points
        joints = recording.truth().positions[0]
        gaps.append(gap(joints, points))
        mirrored.append(gap(joints * [-1.0, 1.0, 1.0], points))
        assert 1.0 < points[:, 2].min() < points[:, 2].max() < 5.0
    assert max(gaps) < 0.15
    assert np.mean(gaps) < 0.7 * np.mean(mirrored)
