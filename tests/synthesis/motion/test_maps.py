"""Maps find the joints and bones that they name, and say what they do not find."""

from __future__ import annotations

import itertools
import re

import numpy as np
import pytest
from motion_cases import body
from places import REFERENCE, ROOT

from regkit.config.document import Document
from regkit.config.model import Model
from regkit.geometry.rigid import rigid
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.system.errors import ConfigError, DataError
from regkit_synthesis.assets import average_hand, average_human
from regkit_synthesis.bodies.bodies import AnyBody, BodyFile, HumanBody, ShippedBody
from regkit_synthesis.bodies.body_map import BodyMap, body_map, fitting_body_map
from regkit_synthesis.bodies.retarget import Retarget
from regkit_synthesis.figure.figure import FIGURE
from regkit_synthesis.figure.joint_map import JointMap
from regkit_synthesis.figure.map_files import shipped
from regkit_synthesis.motion.bvh import read_bvh
from regkit_synthesis.motion.clip import RIG
from regkit_synthesis.motion.config import AnyMotion
from regkit_synthesis.motion.keyframes import Keyframes
from regkit_synthesis.motion.shipped import BVH

R_GROUND_FILE = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""From x left, y up, z forward to x left, y backward, z up."""

JOINTS = {joint: joint for joint in FIGURE if joint != "spine"}


class Config(Model):
    motion: AnyMotion
    body: AnyBody = ShippedBody()


def _config(tmp_path, text):
    path = tmp_path / "config.yaml"
    path.write_text(text)
    return Document.read(path).validated(Config)


def test_landmarks_of_every_body_are_the_same_twenty_joints(reference_data):
    names = list(body("average").landmarks)
    assert len(names) == 20
    for other in ("anny", "cesium_man"):
        assert sorted(body(other).landmarks) == sorted(names)


@pytest.mark.parametrize("name", shipped("bodies"))
def test_body_map_that_ships_is_symmetric(name):
    """A joint of the left is followed by as many bones as its counterpart of the right."""
    found = body_map(name)
    followed = [str(joint) for joint in found.bones.values()]
    for joint in FIGURE:
        if joint.startswith("left_"):
            mirrored = joint.replace("left_", "right_")
            assert followed.count(joint) == followed.count(mirrored)
            assert (joint in found.joints) == (mirrored in found.joints)


def test_names_are_found_in_any_namespace():
    parts = JointMap(joints=JOINTS).parts([f"rig:{joint}" for joint in FIGURE])
    assert parts["left_knee"] == "rig:left_knee"


def test_first_of_several_names_is_taken():
    several = JointMap(joints={**JOINTS, "chest": ("spine3", "spine2")})
    names = [*FIGURE, "spine2"]
    assert several.parts(names)["chest"] == "spine2"
    assert several.parts([*names, "spine3"])["chest"] == "spine3"


def test_joint_map_names_a_joint_that_is_not_there():
    with pytest.raises(ConfigError, match=r"no joint 'left_elbow' .* did you mean 'left_elbo'"):
        JointMap(joints=JOINTS).parts([*(j for j in FIGURE if j != "left_elbow"), "left_elbo"])


def test_source_without_a_map_that_fits_is_told(tmp_path):
    path = tmp_path / "strange.bvh"
    path.write_text(BVH.path("kneel").read_text().replace("LeftKnee", "KneeOfTheLeft"))
    with pytest.raises(ConfigError, match=r"strange\.bvh: none of the maps that ship .* map"):
        read_bvh(path)


def test_body_without_a_map_that_fits_is_told():
    with pytest.raises(ConfigError, match="none of the maps that ship"):
        fitting_body_map(average_hand())


def test_map_of_the_user_is_found_from_where_it_is_named(tmp_path):
    (tmp_path / "mine.yaml").write_text(
        "joints:\n"
        + "".join(
            f"  {joint}: {own}\n" for joint, own in read_bvh(BVH.path("kneel")).rig.parts.items()
        )
    )
    config = _config(
        tmp_path, f"motion: {{kind: bvh, path: {BVH.path('kneel')}, map: mine.yaml}}\n"
    )
    assert config.motion.motion().rig.parts["pelvis"] == "Hips"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("motion: {kind: clip, name: wlak}", r"config\.yaml:1: motion: .*did you mean 'walk'"),
        ("motion: {kind: clip}", r"give either a path or a name \(.*dance_a"),
        ("motion: {kind: keyframes, name: sqat}", "did you mean 'squat'"),
        ("motion: {kind: keyframes, name: wave, frames: [{time: 0}, {time: 1}]}", "give one of"),
        ("motion: {kind: wave}", "'clip', 'bvh', 'gltf', 'keyframes'"),
    ],
)
def test_configuration_says_what_would_be_right(tmp_path, text, message):
    with pytest.raises(ConfigError, match=message):
        _config(tmp_path, text)


def test_examples_of_the_guide_are_right(tmp_path):
    guide = ROOT / "docs" / "how-to" / "motion.md"
    blocks = re.findall(r"```yaml\n(.*?)```", guide.read_text(), re.DOTALL)
    motions, bodies, keyframes = blocks[0], blocks[1], blocks[-1]
    for line in motions.splitlines():
        _config(tmp_path, f"motion: {line.removeprefix('- ')}\n")
    for line in bodies.splitlines():
        _config(tmp_path, f"motion: {{kind: clip, name: walk}}\nbody: {line.removeprefix('- ')}\n")
    path = tmp_path / "keyframes.yaml"
    path.write_text(keyframes)
    assert Document.read(path).validated(Keyframes).motion().duration == 2.2


def test_unknown_map_is_answered_with_those_that_ship(tmp_path):
    config = _config(tmp_path, "motion: {kind: bvh, name: kneel, map: bivoision}")
    with pytest.raises(ConfigError, match=r"biovision, cesium_man, cmu, mixamo.*'biovision'"):
        config.motion.motion()


def _changed(**bones):
    known = body_map("anny_cmu")
    return known.model_copy(update={"bones": {**known.bones, **bones}})


def test_bone_that_a_body_lacks_is_told():
    with pytest.raises(ConfigError, match=r"no bone 'LeftThumb'.*LThumb"):
        Retarget.of(RIG, average_human(), _changed(LeftThumb="left_wrist"))


def test_joint_that_neither_figure_nor_source_has_is_told():
    with pytest.raises(ConfigError, match="'LThumb' follows 'left_thumb', which neither"):
        Retarget.of(RIG, average_human(), _changed(LThumb="left_thumb"))


def test_bone_may_follow_a_joint_that_only_the_source_has():
    source = read_bvh(BVH.path("walk_and_turn"))
    thumb = "mixamorig:LeftHandThumb1"
    moved = Retarget.of(source.rig, average_human(), _changed(LThumb=thumb))
    pose = source.at(0.5)
    bone = moved.mesh.bone("LThumb")
    expected = pose.rotations[thumb] @ moved.mesh.rest[bone, :3, :3]
    assert abs(moved.bone_poses(pose)[bone, :3, :3] - expected).max() < 1e-6


def _stick_figure(recording):
    """A body of one vertex for each joint of a BVH file, in the file's axes: y up, z forward."""
    rig = recording.rig
    names = list(rig.parents)
    places = np.array([rig.places[name] for name in names]) @ R_GROUND_FILE
    return SkinnedMesh(
        vertices=places,
        faces=np.array([[0, 1, 2]]),
        labels=tuple(names),
        parents=np.array([names.index(p) if p else -1 for p in rig.parents.values()]),
        rest=rigid(np.tile(np.eye(3), (len(names), 1, 1)), places),
        indices=np.arange(len(names))[:, None],
        weights=np.ones((len(names), 1)),
    )


def test_body_with_the_rig_of_its_source_moves_as_the_source():
    source = read_bvh(BVH.path("walk_and_turn"), scale=0.01)
    mesh = _stick_figure(source)
    human = HumanBody.of(mesh, fitting_body_map(mesh))
    moved = Retarget.of(source.rig, human.mesh, human.map)
    names = list(source.rig.parents)
    for time in (0.0, 0.9, 2.0):
        pose = source.at(time)
        origins = moved.bone_poses(pose)[:, :3, 3]
        for joint in ("hip", "knee", "ankle"):
            # Hips are where they were, and so is all that hangs on them.
            own = names.index(source.rig.parts[f"left_{joint}"])
            assert np.allclose(origins[own], _placed(source.rig, pose, names[own]), atol=1e-6)


def _placed(rig, pose, joint):
    """Where a joint of a source is (3,), by its own chain from the middle of the hips."""
    chain = [joint]
    while rig.parents[chain[-1]]:
        chain.append(rig.parents[chain[-1]])
    root = chain[-1]
    hips = [rig.places[rig.parts[f"{side}_hip"]] for side in ("left", "right")]
    place = pose.root - pose.rotations[root] @ (sum(hips) / 2 - rig.places[root])
    for parent, child in itertools.pairwise(reversed(chain)):
        place = place + pose.rotations[parent] @ (rig.places[child] - rig.places[parent])
    return place


def test_body_map_must_say_where_the_legs_are():
    with pytest.raises(ValueError, match="it must say where left_knee are"):
        BodyMap(joints={j: j for j in body_map("anny_cmu").joints if j != "left_knee"}, bones={})


def test_body_file_names_its_place(reference_data):
    path = REFERENCE / "anny_cc0" / "anny_body.npz"
    with pytest.raises(ConfigError, match=r"anny_body\.npz: there is no shape 9; the file holds 3"):
        BodyFile(path=path, shape=9).body()
    with pytest.raises(ConfigError, match=r"npz with the map anny_cmu: .*no bone 'Hips'"):
        BodyFile(path=path, map="anny_cmu").body()


def test_body_of_another_format_is_refused(tmp_path):
    with pytest.raises(DataError, match=r"must be \.npz, \.glb or \.gltf, not '\.fbx'"):
        BodyFile(path=tmp_path / "body.fbx").body()
