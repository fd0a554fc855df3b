"""``regkit import`` and rigged glTF bodies in ``regkit fit``: templates of others' skeletons."""

from pathlib import Path

import numpy as np
import pytest
from places import ASSETS, EXAMPLES
from small_experiment import QUICK

from regkit.body import BodyDescription
from regkit.config.document import Document
from regkit.interchange.gltf.gltf import RiggedBody

LICENSED = ASSETS / "motion_bvhtoolbox"
BVH = LICENSED / "mocapbank.bvh"
ROBOT = """<robot name="gripper">
  <link name="palm"><collision><geometry><box size="0.1 0.06 0.04"/></geometry></collision></link>
  <link name="left"><visual><geometry><mesh filename="left.stl"/></geometry></visual></link>
  <link name="right"/>
  <link name="tip"/>
  <joint name="open" type="revolute"><parent link="palm"/><child link="left"/>
    <origin xyz="0.05 0.02 0"/><axis xyz="0 0 1"/><limit lower="-0.1" upper="0.9"/></joint>
  <joint name="close" type="revolute"><parent link="palm"/><child link="right"/>
    <origin xyz="0.05 -0.02 0"/><axis xyz="0 0 1"/><limit lower="-0.9" upper="0.1"/>
    <mimic joint="open" multiplier="-1"/></joint>
  <joint name="end" type="fixed"><parent link="left"/><child link="tip"/>
    <origin xyz="0.08 0 0"/></joint>
</robot>
"""


@pytest.fixture
def out(tmp_path) -> Path:
    return tmp_path / "imported.yaml"


def read(path: Path) -> BodyDescription:
    return Document.read(path).validated(BodyDescription)


def test_an_imported_skeleton_is_registered(regkit, files, out):
    assert "--scale 0.01" in regkit("import", BVH, "--out", out).err
    ended = regkit("import", BVH, "--scale", 0.01, "--out", out, "--name", "A dancer")
    assert "--scale" not in ended.err
    assert ended.code == 0, ended.err
    assert "segments: 19 (18 ball); capsules: 21; height: 1.673 m" in ended.out
    assert "along their bones: 19" in ended.out
    assert f"template: {{kind: file, path: {out}}}" in ended.out
    assert regkit("validate", out).out.strip() == f"{out}: a valid template"
    assert out.read_text().startswith("# Made by `regkit import mocapbank.bvh --scale 0.01`.")
    assert read(out).title == "A dancer"
    template = f"template={{kind: file, path: {out}, size: 1.7}}"
    settings = ("--set", template, "--set", "dataset.compared=false", *QUICK)
    ended = regkit("run", files.experiment, "--out", files.out, *settings)
    assert ended.code in (0, 3), ended.err  # A dancer's proportions are not this person's.
    assert files.metrics()["gsog"]["mean"]["surface_distance_mm"] < 100.0


@pytest.mark.filterwarnings("default::regkit.system.notes.RegkitWarning")
def test_a_robots_limits_and_followers_are_in_its_template(regkit, tmp_path, out):
    robot = tmp_path / "gripper.urdf"
    robot.write_text(ROBOT)
    ended = regkit("import", robot, "--out", out)
    assert ended.code == 0, ended.err
    assert "segments: 4 (2 hinge, 1 fixed); capsules: 2" in ended.out
    assert "warning: " in ended.err
    assert "left.stl" in ended.err
    assert regkit("validate", out).code == 0
    text = out.read_text()
    # x forward is the body's z, y left its x, and z up its y.
    assert "joint: {type: hinge, axis: y, limits_deg: [-5.7, 51.6]}" in text
    assert "coupled: {to: left, ratio: -1}" in text
    assert "# Joint 'close', revolute." in text
    segments = read(out).segments
    assert segments["left"].offset == (0.02, 0.0, 0.05)
    assert segments["left"].capsules[0].end == segments["tip"].offset == (0.0, 0.0, 0.08)


def test_a_mistake_in_a_file_is_told_with_its_line(regkit, tmp_path, out):
    robot = tmp_path / "gripper.urdf"
    robot.write_text(ROBOT.replace('"open" type="revolute"', '"open" type="planar"'))
    ended = regkit("import", robot, "--out", out)
    assert ended.code == 1
    assert f"{robot}:6: " in ended.err
    assert "planar: open" in ended.err
    assert not out.exists()


def test_other_files_are_not_replaced(regkit, tmp_path):
    notes = tmp_path / "notes.txt"
    notes.write_text("mine")
    ended = regkit("import", BVH, "--out", notes)
    assert ended.code == 1
    assert "is not a template" in ended.err
    assert notes.read_text() == "mine"


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        ((BVH, "--scale", 0), "--scale: the scale is 0; it must be positive"),
        ((BVH, "--up", "up"), "--up: 'up' is not an axis (there are: x, y, z, -x, -y, -z)"),
        ((BVH, "--package", "none"), "--package: none is not a folder"),
        ((BVH, "--front", "-y"), "--front: up is y; the front cannot be -y"),
        ((LICENSED / "LICENSE",), "cannot be imported; use .bvh, .urdf, or a body model"),
        (("none.bvh",), "none.bvh: there is no such file"),
    ],
)
def test_what_cannot_be_imported_is_refused(regkit, out, arguments, complaint):
    ended = regkit("import", *arguments, "--out", out)
    assert ended.code == 1
    assert complaint in ended.err
    assert not out.exists()


@pytest.mark.long
def test_a_foreign_hand_becomes_a_template(regkit, reference_data, out):
    hand = reference_data / "webxr_generic_hand_mit" / "left.glb"
    bones = EXAMPLES / "maps" / "webxr_hand.yaml"
    template = "{kind: hand, side: left}"
    ended = regkit("fit", hand, "--template", template, "--map", bones, "--out", out)
    assert ended.code == 0, ended.err
    assert regkit("validate", out).code == 0
    mesh = RiggedBody.read(hand).mesh
    joints = [f"middle-finger-phalanx-{name}" for name in ("proximal", "intermediate", "distal")]
    bones = np.diff([mesh.origin(joint) for joint in joints], axis=0)
    lengths = [np.linalg.norm(read(out).segments[f"middle_{k}"].offset) for k in (2, 3)]
    assert lengths == pytest.approx(np.linalg.norm(bones, axis=1), abs=1e-4)


def test_a_tree_is_named_only_for_gltf(regkit, tmp_path, out):
    (tmp_path / "tree.yaml").write_text("a: null\n")
    body = EXAMPLES.parents[1] / "plugins" / "regkit_synthesis" / "assets" / "anny" / "body.npz"
    ended = regkit("fit", body, "--parents", tmp_path / "tree.yaml", "--out", out)
    assert ended.code == 1
    assert "names the bones' parents itself" in ended.err


@pytest.mark.filterwarnings("default")
def test_limits_of_a_robot_beyond_a_hundred_turns_are_a_hundred_and_told(regkit, tmp_path):
    robot, out = tmp_path / "r.urdf", tmp_path / "r.yaml"
    robot.write_text(
        '<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="revolute">'
        '<parent link="a"/><child link="b"/><origin xyz="0 0 1"/><axis xyz="0 0 1"/>'
        '<limit lower="0" upper="1e10" effort="1" velocity="1"/></joint></robot>'
    )
    ended = regkit("import", robot, "--out", out)
    assert ended.code == 0, ended.err
    assert "'j'" in ended.err
    assert Document.read(out).data["segments"]["b"]["joint"]["limits_deg"] == [0, 36000]
