"""Skeletons of BVH and URDF files: they move as their files' joints do."""

from pathlib import Path

import numpy as np
import pytest
from places import ASSETS
from scipy.spatial.transform import Rotation

from regkit.body import Body
from regkit.interchange.axes import body_axes
from regkit.interchange.bones import THICKNESS
from regkit.interchange.bvh.bvh import Bvh
from regkit.interchange.imported import ImportedSkeleton
from regkit.interchange.skeletons import read_skeleton
from regkit.interchange.urdf.urdf import Urdf
from regkit.skeleton import Pose
from regkit.system.errors import ConfigError, DataError
from regkit.system.notes import RegkitWarning

ASSET = ASSETS / "motion_bvhtoolbox" / "mocapbank.bvh"

SHORT = """HIERARCHY
ROOT hip
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation
  JOINT spine
  {
    OFFSET 0 4 1
    CHANNELS 2 Zrotation Xrotation
    JOINT head
    {
      OFFSET 0 3 0
      CHANNELS 1 Yrotation
      JOINT hat { OFFSET 0 1 0 CHANNELS 0
        End Site { OFFSET 0 0.5 0 }
      }
    }
  }
  JOINT leg
  {
    OFFSET 1 0 0
    CHANNELS 6 Xposition Yposition Zposition Yrotation Xrotation Zrotation
    End Site
    {
      OFFSET 0 -6 0
    }
  }
}
MOTION
Frames: 1
Frame Time: 0.1
0 9 0 10 20 30 40 50 60 2 0 0.5 70 -80 15
""".replace(" OFFSET 0 1 0 CHANNELS 0", "\nOFFSET 0 1 0\nCHANNELS 0").replace(
    "{ OFFSET 0 0.5 0 }", "{\nOFFSET 0 0.5 0\n}"
)


def _body(imported: ImportedSkeleton) -> Body:
    description = imported.description
    return description.body("imported", description.size.value)


def _pose(body: Body, root: np.ndarray, turns: dict[str, np.ndarray]) -> Pose:
    """A pose of rotation vectors for ball joints and of angles for others [rad]."""
    pose = body.skeleton.rest(root)
    step = np.zeros(body.skeleton.dofs)
    for name, angles in turns.items():
        step[body.skeleton.dofs_of(name)] = angles
    moved = body.skeleton.retract(pose, step)
    return Pose(root, moved.balls, body.skeleton.limits.couplings.coupled(moved.hinges))


def _angles(motion: Bvh, frame: int) -> dict[str, list[tuple[str, float]]]:
    numbers = iter(motion.frames[frame])
    return {
        joint.name: [
            (channel[0], np.radians(value))
            for channel in joint.channels
            for value in [next(numbers)]
            if channel.endswith("rotation")
        ]
        for joint in motion.joints
    }


@pytest.mark.parametrize("axes", [("y", "z"), ("z", "x"), ("-x", "y")])
@pytest.mark.parametrize("short", [True, False])
def test_a_bvh_skeleton_moves_as_its_file_does(
    tmp_path: Path, axes: tuple[str, str], short: bool
) -> None:
    path = ASSET
    if short:
        path = tmp_path / "short.bvh"
        path.write_text(SHORT)
    imported = read_skeleton(path, scale=0.01, up=axes[0], front=axes[1])
    body, motion, turn = _body(imported), Bvh.read(path, scale=0.01), body_axes(*axes)
    for frame in (0, len(motion.frames) // 2, -1):
        truth = motion.at_frame(frame)
        turns: dict[str, np.ndarray] = {}
        for name, angles in _angles(motion, frame).items():
            if len(angles) == 3 and name != motion.names[0]:
                letters, values = "".join(a for a, _ in angles), [v for _, v in angles]
                turns[name] = turn @ Rotation.from_euler(letters, values).as_rotvec()
            elif angles and name != motion.names[0]:
                turns[name] = np.array([value for _, value in angles])
        root = np.eye(4)
        root[:3, :3] = turn @ truth.rotations[0] @ turn.T
        root[:3, 3] = turn @ truth.positions[0]
        placed = body.place(_pose(body, root, turns)).transforms
        for joint, name in enumerate(motion.names):
            own = placed[body.skeleton.names.index(name)]
            np.testing.assert_allclose(own[:3, 3], turn @ truth.positions[joint], atol=1e-9)
            np.testing.assert_allclose(
                own[:3, :3], turn @ truth.rotations[joint] @ turn.T, atol=1e-9
            )
        markers = dict(zip(body.markers.names, body.markers.place(placed), strict=True))
        for joint, one in enumerate(motion.joints):
            for end in one.ends:
                at = truth.positions[joint] + truth.rotations[joint] @ end
                np.testing.assert_allclose(markers[f"{one.name}_end"], turn @ at, atol=1e-9)


def test_channels_tell_the_type_of_a_joint(tmp_path: Path) -> None:
    path = tmp_path / "short.bvh"
    path.write_text(SHORT)
    imported = read_skeleton(path, scale=0.1)
    segments = imported.description.segments
    assert {name: one.joint.type for name, one in segments.items()} == {
        "hip": "free",
        "spine": "universal",
        "head": "hinge",
        "hat": "fixed",
        "leg": "ball",
    }
    assert segments["spine"].joint.axes == ((0, 0, 1), (1, 0, 0))
    # A position channel stands in place of the offset; here it is the same in all frames.
    assert segments["leg"].offset == pytest.approx((0.2, 0.0, 0.05))
    # The twist of a limb is about its own direction.
    assert segments["leg"].joint.twist_axis == (0, -1, 0)
    assert imported.description.size.name == "height"
    assert imported.description.size.value == pytest.approx(0.6 + 0.4 + 0.3 + 0.1 + 0.05)
    assert imported.shaped == 5
    (capsule,) = segments["spine"].capsules
    assert capsule.end == segments["head"].offset
    assert capsule.radius == pytest.approx(THICKNESS * 0.3)


def test_a_bone_that_changes_its_length_is_told_or_refused(tmp_path: Path) -> None:
    path = tmp_path / "short.bvh"
    text = SHORT.replace("Frames: 1", "Frames: 2")
    last = text.splitlines()[-1]
    path.write_text(text + last.replace(" 2 0 0.5 ", " 2 0.5 0.5 ") + "\n")
    with pytest.warns(RegkitWarning, match="leg: 6"):
        imported = read_skeleton(path)
    assert imported.description.segments["leg"].offset == pytest.approx((2.0, 0.25, 0.5))
    path.write_text(text + last.replace(" 2 0 0.5 ", " 2 3 0.5 ") + "\n")
    with pytest.raises(DataError, match=r"'leg' moves by 37\.5 % "):
        read_skeleton(path)


ROBOT = """<?xml version="1.0"?>
<robot name="arm">
  <link name="base"><collision><origin xyz="0 0 0.1"/>
    <geometry><cylinder radius="0.1" length="0.4"/></geometry></collision></link>
  <link name="upper"><visual><geometry><mesh filename="upper.stl"/></geometry></visual></link>
  <link name="lower">
    <visual><geometry><sphere radius="9"/></geometry></visual>
    <collision><origin xyz="0.1 0 0" rpy="0 1.5707963267948966 0"/>
      <geometry><capsule radius="0.03" length="0.2"/></geometry></collision>
  </link>
  <link name="hand"><collision><geometry><box size="0.06 0.1 0.02"/></geometry></collision></link>
  <link name="finger"/>
  <link name="thumb"><collision><geometry><sphere radius="0.01"/></geometry></collision></link>
  <joint name="turn" type="continuous">
    <parent link="base"/><child link="upper"/><origin xyz="0 0 0.3" rpy="0.1 -0.2 0.3"/>
    <axis xyz="0 0 2"/></joint>
  <joint name="bend" type="revolute">
    <parent link="upper"/><child link="lower"/><origin xyz="0.3 0.02 0" rpy="-0.4 0.5 0.6"/>
    <axis xyz="0 1 1"/><limit lower="-1" upper="2" effort="1" velocity="1"/></joint>
  <joint name="wrist" type="spherical">
    <parent link="lower"/><child link="hand"/><origin xyz="0.2 0 0"/></joint>
  <joint name="grip" type="revolute">
    <parent link="hand"/><child link="finger"/><origin xyz="0.05 0.03 0" rpy="0 0 1"/>
    <limit upper="0.8"/><mimic joint="pinch" multiplier="-0.5" offset="0.1"/></joint>
  <joint name="pinch" type="continuous">
    <parent link="hand"/><child link="thumb"/><origin xyz="0.05 -0.03 0"/><axis xyz="0 0 1"/>
    <mimic joint="bend" multiplier="0.2"/></joint>
</robot>
"""


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    path = tmp_path / "arm.urdf"
    path.write_text(ROBOT)
    return path


def _chained(robot: Urdf, turns: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """T_base_link of every link, for rotation vectors in the links' frames; joint after joint."""
    placed: dict[str, np.ndarray] = {}
    for name in robot.links:
        if name not in robot.joints:
            placed[name] = np.eye(4)
            continue
        joint = robot.joints[name]
        own = np.eye(4)
        own[:3, :3] = Rotation.from_rotvec(turns.get(name, np.zeros(3))).as_matrix()
        placed[name] = placed[joint.parent] @ joint.origin @ own
    return placed


def _check_moves_as_chained(path: Path, scale: float, random: np.random.Generator) -> None:
    imported = read_skeleton(path, scale=scale)
    body, robot, axes = _body(imported), Urdf.read(path), body_axes("z", "x")
    assert body.skeleton.names[0] == next(iter(robot.links))
    still = _chained(robot, {})
    for _ in range(5):
        turns: dict[str, np.ndarray] = {}
        steps: dict[str, np.ndarray] = {}
        angles = {joint.name: random.uniform(-2.0, 2.0) for joint in robot.joints.values()}
        for name, joint in robot.joints.items():
            if joint.kind == "spherical":
                turns[name] = random.normal(size=3)
                # The segment's frame is the link's at zero angles, in the body's axes.
                steps[name] = axes @ still[name][:3, :3] @ turns[name]
            elif joint.kind != "fixed":
                angle = angles[joint.name]
                if joint.mimic is not None:
                    angle = joint.mimic.ratio * angles[joint.mimic.joint] + joint.mimic.offset
                else:
                    steps[name] = np.array([angle])
                turns[name] = angle * joint.axis
        truth = _chained(robot, turns)
        placed = body.place(_pose(body, np.eye(4), steps)).transforms
        for name, transform in truth.items():
            own = placed[body.skeleton.names.index(name)]
            np.testing.assert_allclose(own[:3, 3], scale * axes @ transform[:3, 3], atol=1e-9)
            turned = axes @ transform[:3, :3] @ still[name][:3, :3].T @ axes.T
            np.testing.assert_allclose(own[:3, :3], turned, atol=1e-9)


@pytest.mark.filterwarnings("ignore:.*upper.stl:regkit.system.notes.RegkitWarning")
def test_a_robot_moves_as_its_chain_of_joints_does(
    robot: Path, random: np.random.Generator
) -> None:
    _check_moves_as_chained(robot, 0.7, random)


def test_the_humanoid_of_bullet_moves_as_its_chain_does(
    reference_data: Path, random: np.random.Generator
) -> None:
    path = reference_data / "humanoid_pybullet_zlib" / "humanoid.urdf"
    _check_moves_as_chained(path, 0.25, random)
    imported = read_skeleton(path, scale=0.25, up="y", front="x")
    assert imported.description.size.name == "height"
    assert imported.description.size.value == pytest.approx(1.63, abs=0.01)
    assert sum(len(one.capsules) for one in imported.description.segments.values()) == 15


def test_roll_pitch_and_yaw_are_about_fixed_axes(robot: Path) -> None:
    upper = Urdf.read(robot).joints["upper"]
    turn = Rotation.from_euler("xyz", [0.1, -0.2, 0.3]).as_matrix()
    np.testing.assert_allclose(upper.origin[:3, :3], turn, atol=1e-12)


@pytest.mark.filterwarnings("ignore:.*upper.stl:regkit.system.notes.RegkitWarning")
def test_a_robots_limits_and_followers_are_kept(robot: Path) -> None:
    segments = read_skeleton(robot).description.segments
    assert segments["upper"].joint.limits_deg is None
    assert segments["lower"].joint.limits_deg == pytest.approx(np.degrees([-1.0, 2.0]))
    assert segments["finger"].joint.limits_deg == pytest.approx((0.0, np.degrees(0.8)))
    # The finger follows the thumb, which follows the elbow.
    finger, thumb = segments["finger"].joint.coupled, segments["thumb"].joint.coupled
    assert (finger.to, thumb.to) == ("lower", "lower")
    assert (finger.ratio, thumb.ratio) == pytest.approx((-0.1, 0.2))
    assert finger.offset_deg == pytest.approx(np.degrees(0.1))


@pytest.mark.filterwarnings("ignore:.*upper.stl:regkit.system.notes.RegkitWarning")
def test_a_robots_shapes_become_capsules(robot: Path) -> None:
    imported = read_skeleton(robot, up="y", front="z")
    segments = imported.description.segments
    (base,) = segments["base"].capsules
    np.testing.assert_allclose([base.start, base.end], [[0, 0, 0], [0, 0, 0.2]], atol=1e-12)
    assert base.radius == 0.1
    # The mesh of the upper arm is missing; a capsule goes to the elbow.
    (upper,) = segments["upper"].capsules
    assert upper.end == segments["lower"].offset
    assert imported.shaped == 1
    lower = Urdf.read(robot)
    still = _chained(lower, {})["lower"][:3, :3]
    (capsule,) = segments["lower"].capsules
    np.testing.assert_allclose(capsule.start, [0, 0, 0], atol=1e-9)
    np.testing.assert_allclose(capsule.end, still @ [0.2, 0, 0], atol=1e-9)
    (hand,) = segments["hand"].capsules
    radius = np.sqrt(0.06 * 0.02 / np.pi)
    assert hand.radius == pytest.approx(radius)
    assert np.linalg.norm(np.subtract(hand.end, hand.start)) == pytest.approx(0.1 - 2 * radius)
    assert segments["finger"].capsules == ()


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ('"bend" type="revolute"', '"bend" type="planar"', 17, "(planar: bend)"),
        ('lower="-1"', 'lower="low"', 19, 'lower="low" of <limit> must be a number'),
        ('<axis xyz="0 1 1"/>', '<axis xyz="0 0 0"/>', 19, "the axis of joint 'bend' is zero"),
        ('xyz="0.3 0.02 0"', 'xyz="0.3 0.02"', 18, 'xyz="0.3 0.02" of <origin> must be 3 numbers'),
        ('<child link="hand"/>', '<child link="hnd"/>', 20, "no link 'hnd'; did you mean 'hand'?"),
        ('<child link="hand"/>', '<child link="lower"/>', 20, "a second joint"),
        ('joint="bend" ', 'joint="grip" ', 22, "joint 'grip' follows itself"),
        ('radius="0.03"', 'radius="-3"', 9, "radius of <capsule> must be positive: -3"),
        ('link name="thumb"', 'link name="hand"', 13, "a second link is named 'hand'"),
        ("</robot>", "</robt>", 28, "not XML: mismatched tag"),
    ],
)  # fmt: skip
def test_what_is_wrong_in_a_robot_is_told_with_its_line(
    robot: Path, old: str, new: str, line: int, message: str
) -> None:
    robot.write_text(ROBOT.replace(old, new))
    with pytest.raises(DataError) as caught:
        read_skeleton(robot)
    assert message in caught.value.message
    assert caught.value.place == f"{robot}:{line}"


def test_other_formats_and_axes_are_refused(robot: Path) -> None:
    with pytest.raises(ConfigError, match=r"'\.fbx' cannot be imported"):
        read_skeleton(Path("a.fbx"))
    with pytest.raises(ConfigError, match=r"^up: 'w' is not an axis"):
        read_skeleton(robot, up="w")
    with pytest.raises(ConfigError, match=r"^front: up is z; the front cannot be -z"):
        read_skeleton(robot, front="-z")
    with pytest.raises(DataError, match="no such file"):
        read_skeleton(robot.with_name("none.urdf"))
    robot.write_text("<sdf/>")
    with pytest.raises(DataError, match=r"arm\.urdf:1: <sdf> where <robot>"):
        read_skeleton(robot)


@pytest.mark.parametrize(
    ("file", "text"),
    [
        (
            "a.bvh",
            "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
            "JOINT l\x80eg\n{\nOFFSET 0 1 0\nCHANNELS 1 Xrotation\n"
            "End Site\n{\nOFFSET 0 1 0\n}\n}\n}\n",
        ),
        (
            "a.urdf",
            '<robot name="r"><link name="a"/><link name="l&#x80;eg"/>'
            '<joint name="j" type="continuous"><origin xyz="0 0 1"/>'
            '<parent link="a"/><child link="l&#x80;eg"/></joint></robot>',
        ),
    ],
)
@pytest.mark.filterwarnings("ignore::regkit.system.notes.RegkitWarning")
def test_a_name_with_control_characters_becomes_one_that_can_be_printed(tmp_path, file, text):
    path = tmp_path / file
    path.write_text(text, encoding="utf-8")
    assert list(read_skeleton(path).description.segments) == ["a", "l_eg"]
