"""BVH files: what they say is where SciPy's rotations put the joints, and wrong ones say where."""

from pathlib import Path

import numpy as np
import pytest
from places import ASSETS
from scipy.spatial.transform import Rotation

from regkit.interchange.bvh.bvh import Bvh
from regkit.system.errors import DataError

ASSET = ASSETS / "motion_bvhtoolbox" / "mocapbank.bvh"

SMALL = """HIERARCHY
ROOT hip
{
  OFFSET 1 2 3
  CHANNELS 4 Zposition Yrotation Xrotation Zrotation
  JOINT knee {
    OFFSET 0 -4 0
    CHANNELS 3 Xrotation Xposition Yrotation
    End Site
    {
      OFFSET 0 -5 1
    }
  }
}
MOTION
Frames: 2
Frame Time: 0.5
7 90 0 0 0 2 0
7 0 90 0 90 2 0
"""


@pytest.fixture
def small(tmp_path: Path) -> Path:
    path = tmp_path / "small.bvh"
    path.write_text(SMALL)
    return path


def _placed_by_scipy(motion: Bvh, frame: int) -> tuple[np.ndarray, np.ndarray]:
    rotations, positions = [], []
    numbers = iter(motion.frames[frame])
    for joint in motion.joints:
        place, angles, axes = np.array(joint.offset), [], ""
        for channel in joint.channels:
            value = next(numbers)
            if channel.endswith("position"):
                place["XYZ".index(channel[0])] = value
            else:
                axes += channel[0]
                angles.append(value)
        own = Rotation.from_euler(axes, angles, degrees=True) if axes else Rotation.identity()
        if joint.parent < 0:
            rotations.append(own)
            positions.append(place)
        else:
            parent = rotations[joint.parent]
            rotations.append(parent * own)
            positions.append(positions[joint.parent] + parent.apply(place))
    return np.array([turn.as_matrix() for turn in rotations]), np.array(positions)


def test_joints_are_where_their_channels_put_them(small: Path) -> None:
    motion = Bvh.read(small, scale=0.1)
    first, second = motion.at_frame(0), motion.at_frame(1)
    # x and y of the root come from its offset, z from its channel; a quarter turn about y takes the
    # knee's x to the world's -z.
    np.testing.assert_allclose(first.positions, [[0.1, 0.2, 0.7], [0.1, -0.2, 0.5]], atol=1e-12)
    # A quarter turn about x takes the knee's -y to -z, and a second one its shin to +y.
    np.testing.assert_allclose(second.positions, [[0.1, 0.2, 0.7], [0.3, 0.2, 0.3]], atol=1e-12)
    tip = second.positions[1] + second.rotations[1] @ motion.joints[1].ends[0]
    np.testing.assert_allclose(tip, [0.3, 0.7, 0.2], atol=1e-12)
    np.testing.assert_allclose(motion.rest_positions, [[0.1, 0.2, 0.3], [0.1, -0.2, 0.3]])


@pytest.mark.parametrize("line_end", ["\n", "\r\n", "\r"])
def test_white_space_and_line_ends_do_not_matter(
    tmp_path: Path, small: Path, line_end: str
) -> None:
    other = tmp_path / "other.bvh"
    text = SMALL.replace(" ", "\t").replace("End\t", "End ").replace("Frame\tT", "Frame T")
    other.write_bytes(text.replace("\n", f" {line_end}{line_end}\t").encode())
    ours, theirs = Bvh.read(small), Bvh.read(other)
    assert ours.names == theirs.names
    np.testing.assert_array_equal(ours.frames, theirs.frames)


def test_real_files_agree_with_scipy_and_survive_writing(
    reference_data: Path, tmp_path: Path
) -> None:
    paths = [*reference_data.glob("motion_bvh/*.bvh"), *reference_data.glob("motion_bvht*/*.bvh")]
    assert len(paths) == 8
    for path in paths:
        motion = Bvh.read(path, scale=0.05)
        copy = tmp_path / path.name
        motion.write(copy, scale=0.01)
        again = Bvh.read(copy, scale=0.01)
        assert again.names == motion.names
        assert again.parents == motion.parents
        assert again.frame_time == pytest.approx(motion.frame_time, rel=1e-9)
        for frame in (0, len(motion.frames) // 2, -1):
            rotations, positions = _placed_by_scipy(motion, frame)
            for pose, tolerance in ((motion.at_frame(frame), 1e-9), (again.at_frame(frame), 1e-8)):
                np.testing.assert_allclose(pose.rotations, rotations, atol=tolerance)
                np.testing.assert_allclose(pose.positions, positions, atol=tolerance)


def test_between_frames_joints_turn_evenly() -> None:
    motion = Bvh.read(ASSET, scale=0.01)
    left, right = motion.at_frame(7), motion.at_frame(8)
    middle, quarter = (motion.at((7.0 + share) * motion.frame_time) for share in (0.5, 0.25))
    for joint, parent in enumerate(motion.parents):
        turns = [
            Rotation.from_matrix(
                pose.rotations[joint]
                if parent < 0
                else pose.rotations[parent].T @ pose.rotations[joint]
            )
            for pose in (left, quarter, middle, right)
        ]
        angles = [(turns[0].inv() * turn).magnitude() for turn in turns]
        np.testing.assert_allclose(angles, np.array([0.0, 0.25, 0.5, 1.0]) * angles[3], atol=1e-7)
    ends = motion.at(-1.0), motion.at(1e9)
    np.testing.assert_allclose(ends[0].positions, motion.at_frame(0).positions)
    np.testing.assert_allclose(ends[1].positions, motion.at_frame(-1).positions)


def test_one_frame_holds_at_every_time(small: Path, tmp_path: Path) -> None:
    path = tmp_path / "one.bvh"
    path.write_text(SMALL.replace("Frames: 2", "Frames: 1").rsplit("\n", 2)[0])
    np.testing.assert_allclose(Bvh.read(path).at(3.0).positions, Bvh.read(small).at(0.0).positions)


@pytest.mark.parametrize(
    ("old", "new", "place", "message"),
    [
        ("HIERARCHY", "SKELETON", "1", "not a BVH file"),
        ("ROOT hip", "JOINT hip", "2", "'JOINT hip' where ROOT"),
        ("OFFSET 0 -4 0", "OFFSET 0 -4", "7", "OFFSET has 2 numbers; it needs 3"),
        ("OFFSET 0 -4 0", "OFFSET 0 -4 O", "7", "not a number"),
        ("Xposition Yrotation", "Xposition Xscale", "8", "'Xscale' is not a channel"),
        ("3 Xrotation X", "4 Xrotation X", "8", "but 3 channels follow"),
        ("Xposition Yrotation", "Xposition Xrotation", "8", "Xrotation occurs twice"),
        ("MOTION", "ROOT other", "15", "'other' is a second ROOT"),
        ("Frames: 2", "Frames: two", "16", "not a number"),
        ("7 90 0 0 0 2 0", "7 90 0 0 0 2", "18", "a frame has 6 numbers; it needs 7"),
        ("7 0 90 0 90 2 0", "7 0 nan 0 90 2 0", "19", "nan; all numbers must be finite"),
        ("}\nMOTION", "MOTION", "14", "'MOTION' where JOINT, End Site or }"),
    ],
)
def test_a_wrong_line_is_named(
    tmp_path: Path, old: str, new: str, place: str, message: str
) -> None:
    path = tmp_path / "wrong.bvh"
    assert SMALL.count(old) == 1
    path.write_text(SMALL.replace(old, new))
    with pytest.raises(DataError) as caught:
        Bvh.read(path)
    assert caught.value.place == f"{path}:{place}"
    assert message in caught.value.message


def test_a_file_that_stops_early_or_is_missing_says_so(tmp_path: Path) -> None:
    path = tmp_path / "short.bvh"
    path.write_text(SMALL[: SMALL.index("}\nMOTION")])
    with pytest.raises(DataError, match=r"short.bvh:13: the file ends where"):
        Bvh.read(path)
    path.write_text("")
    with pytest.raises(DataError, match=r"short.bvh:1: the file ends where HIERARCHY"):
        Bvh.read(path)
    path.write_bytes(b"\x89PNG\xff\xfe\x00")
    with pytest.raises(DataError, match="not a BVH file"):
        Bvh.read(path)
    with pytest.raises(DataError, match="no such file"):
        Bvh.read(tmp_path / "none.bvh")
