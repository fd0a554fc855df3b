"""Prismatic joints: segments that slide, declared in the skeleton and registered like hinges."""

from pathlib import Path

import numpy as np
import pytest

from regkit.body import Body, BodyDescription
from regkit.body.writing import template_text
from regkit.casadi import configuration, forward_kinematics
from regkit.config.document import Document
from regkit.interfaces import Method, Prior, Scene, Term
from regkit.observation import Observation
from regkit.skeleton import Mirroring, Placement, Pose, PoseDescription
from regkit.system.errors import ConfigError
from tests.support.lamp import facing, seen

CRANE = """
title: A mast on which a carriage slides, with an arm and a gripper of two fingers.
size: {name: height, value: 1.0, range: [0.5, 2.0]}
upright: true
segments:
  mast:
    joint: {type: free}
    capsules: [{start: [0, -0.4, 0], end: [0, 0.5, 0], radius: [0.09, 0.05]}]
    markers: {foot: [0, -0.4, 0], top: [0, 0.5, 0]}
  carriage:
    parent: mast
    offset: [0, 0, 0.05]
    rotation_deg: [10, 0, 5]
    joint: {type: prismatic, axis: [0, 1, 0.2], limits: [-0.2, 0.3]}
    capsules: [{start: [-0.12, 0, 0], end: [0.12, 0, 0], radius: 0.06}]
  arm:
    parent: carriage
    offset: [0.1, 0, 0.04]
    joint: {type: hinge, axis: z, limits_deg: [-80, 80]}
    capsules: [{start: [0, 0, 0], end: [0.4, 0, 0], radius: [0.05, 0.04]}]
    markers: {wrist: [0.4, 0, 0]}
  left_finger:
    parent: arm
    offset: [0.42, 0.05, 0]
    joint: {type: prismatic, axis: y, limits: [0, 0.1]}
    capsules: [{start: [0, 0, 0], end: [0.15, 0, 0], radius: 0.03}]
  right_finger:
    parent: arm
    offset: [0.42, -0.05, 0]
    joint: {type: prismatic, axis: -y, limits: [-0.02, 0.08],
            coupled: {to: left_finger, ratio: 1, offset: -0.01}}
    capsules: [{start: [0, 0, 0], end: [0.15, 0, 0], radius: 0.03}]
    markers: {tip: [0.15, 0, 0]}
stances:
  open: {joints: {left_finger: 0.08, carriage: 0.1, arm: -20}}
"""


def described(folder: Path, text: str = CRANE) -> BodyDescription:
    path = folder / "crane.yaml"
    path.write_text(text)
    return Document.read(path).validated(BodyDescription)


@pytest.fixture
def crane(tmp_path: Path) -> Body:
    return described(tmp_path).body("crane", 1.0)


def method(preset: str, **fields: object) -> Method:
    return Method.parse({"preset": preset, **fields}, place="test", field="method")


def moved(body: Body, random: np.random.Generator) -> Pose:
    bones = body.skeleton
    pose = bones.retract(bones.rest(), 0.3 * random.normal(size=bones.dofs))
    return bones.limits.projected(pose)


def test_a_prismatic_joint_slides_its_segment_along_the_axis(crane) -> None:
    bones = crane.skeleton
    at = [
        crane.place(bones.pose(PoseDescription(joints={"carriage": by}))).transforms
        for by in (-0.1, 0.2)
    ]
    index = bones.names.index("carriage")
    along = at[0][index, :3, :3] @ np.array([0.0, 1.0, 0.2]) / np.hypot(1.0, 0.2)
    np.testing.assert_allclose(at[1][index, :3, 3] - at[0][index, :3, 3], 0.3 * along, atol=1e-12)
    np.testing.assert_allclose(at[1][:, :3, :3], at[0][:, :3, :3], atol=1e-12)
    mast = bones.names.index("mast")
    np.testing.assert_array_equal(at[0][mast], at[1][mast])


def test_displacements_and_their_limits_grow_with_the_size(tmp_path) -> None:
    description = described(tmp_path)
    small, large = (description.body("crane", size).skeleton.limits for size in (0.5, 2.0))
    slides = small.prismatic
    np.testing.assert_allclose(large.hinge[slides], 4.0 * small.hinge[slides])
    np.testing.assert_allclose(large.hinge[~slides], small.hinge[~slides])
    np.testing.assert_allclose(large.couplings.offsets, 4.0 * small.couplings.offsets)


def test_the_jacobian_is_the_derivative_of_the_placement(crane, random) -> None:
    bones, step = crane.skeleton, 1e-6
    pose = moved(crane, random)
    placement = Placement.of(bones, pose)
    segments = np.arange(len(bones.names))
    arms = random.normal(size=(len(segments), 3))

    def points(at: Pose) -> np.ndarray:
        placed = crane.place(at).transforms
        return np.einsum("sij,sj->si", placed[:, :3, :3], arms) + placed[:, :3, 3]

    for axis in np.eye(3):
        rows = placement.rows(segments, points(pose), np.tile(axis, (len(segments), 1)))
        for dof in range(bones.dofs):
            ahead, back = (
                points(bones.retract(pose, sign * step * np.eye(bones.dofs)[dof])) @ axis
                for sign in (1, -1)
            )
            np.testing.assert_allclose(rows[:, dof], (ahead - back) / (2 * step), atol=1e-8)


def test_casadi_places_the_segments_alike(crane, random) -> None:
    pose = moved(crane, random)
    numbers = configuration(crane.skeleton, pose)
    found = np.array(forward_kinematics(crane.skeleton)(numbers))
    expected = np.concatenate(list(crane.place(pose).transforms), axis=1)
    np.testing.assert_allclose(found, expected, atol=1e-12)


def test_the_follower_and_all_limits_hold_in_samples_and_projections(crane, random) -> None:
    bones = crane.skeleton
    balls, hinges = bones.limits.sampled(random, 200)
    names = list(bones.hinge_names)
    left, right = names.index("left_finger"), names.index("right_finger")
    np.testing.assert_allclose(hinges[:, right], hinges[:, left] - 0.01, atol=1e-12)
    assert np.ptp(hinges[:, names.index("carriage")]) > 0.4
    for row in range(200):
        pose = Pose(np.eye(4), balls[row], hinges[row])
        assert bones.limits.violation(pose).max() < 1e-12
    far = bones.retract(bones.rest(), np.full(bones.dofs, 0.7))
    assert bones.limits.violation(far).max() > 0.1
    assert bones.limits.violation(bones.limits.projected(far)).max() < 1e-9


def test_a_template_is_written_and_read_alike(tmp_path) -> None:
    description = described(tmp_path)
    again = described(tmp_path, template_text(description, "A crane.", {}))
    one, other = description.body("crane", 1.0), again.body("crane", 1.0)
    np.testing.assert_allclose(one.skeleton.hinge_twists, other.skeleton.hinge_twists, atol=1e-4)
    np.testing.assert_allclose(one.skeleton.limits.hinge, other.skeleton.limits.hinge, atol=1e-4)
    found = other.skeleton.limits.couplings.offsets
    np.testing.assert_allclose(found, one.skeleton.limits.couplings.offsets)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("limits: [0, 0.1]", "limits: [0.1, 0]", "limits are reversed"),
        ("limits: [0, 0.1]", "limits_deg: [0, 10]", "limits_deg"),
        ("to: left_finger", "to: arm", "'arm' is not a prismatic joint"),
        ("offset: -0.01", "offset: -0.2", "no position of 'left_finger' satisfies all limits"),
        ("to: left_finger", "to: right_finger", "a prismatic joint cannot follow itself"),
    ],
)
def test_what_contradicts_itself_is_refused(tmp_path, old, new, message) -> None:
    with pytest.raises(ConfigError) as caught:
        described(tmp_path, CRANE.replace(old, new))
    assert message in caught.value.message or message in str(caught.value)


@pytest.mark.parametrize("kind", ["limits", "continuity", "motion_prior"])
def test_terms_have_their_gradient_in_metres(crane, random, kind) -> None:
    bones = crane.skeleton
    term = Term.parse(kind, place="test", field="term")
    pose = bones.retract(bones.rest(), 0.4 * random.normal(size=bones.dofs))
    primitives = method("best").bind(crane).primitives
    placed = primitives.place(crane.place(pose).transforms)
    observation = Observation(np.zeros((1, 3)), np.ones(1), np.full(1, 1e-4))
    energy = term.bind(Scene(crane, observation, Prior(bones.rest()), placed))
    response, step = energy(pose), 1e-6
    for dof in range(bones.ball_dofs.start, bones.dofs):
        ahead, back = (
            energy(bones.retract(pose, sign * step * np.eye(bones.dofs)[dof])).energy
            for sign in (1, -1)
        )
        assert response.force[dof] == pytest.approx((ahead - back) / (2 * step), abs=1e-6)
    assert np.abs(response.force[bones.hinge_dofs][bones.limits.prismatic]).max() > 0.0


def test_a_rotation_is_not_asked_of_a_joint_that_slides(crane) -> None:
    with pytest.raises(ConfigError, match=r"joints_deg\.carriage: .*prismatic"):
        Term.parse(
            {"kind": "continuity", "joints_deg": {"carriage": 5}}, place="test", field="term"
        ).check(crane)


@pytest.mark.parametrize("compiled", [True, False])
def test_displacements_are_registered(crane, compiled) -> None:
    truth = facing(crane, 0.3, {"carriage": 0.12, "arm": 25.0, "left_finger": 0.06})
    start = facing(crane, 0.25, {"carriage": 0.05, "arm": 15.0, "left_finger": 0.02})
    spheres = method("spheres", compiled=compiled)
    found = spheres.bind(crane).register(seen(crane, truth, image=True), [start]).pose
    slides = crane.skeleton.limits.prismatic
    np.testing.assert_allclose(found.hinges[slides], truth.hinges[slides], atol=0.004)
    np.testing.assert_allclose(found.hinges[~slides], truth.hinges[~slides], atol=np.radians(1))
    assert crane.skeleton.limits.couplings.residuals(found.hinges) == pytest.approx(0.0, abs=1e-12)


def test_sides_that_slide_are_mirrored(tmp_path) -> None:
    text = CRANE.replace("offset: [0.1, 0, 0.04]", "offset: [0, 0, 0.04]")
    text = text.replace("offset: [0.42, 0.05, 0]", "offset: [0.05, 0.42, 0]")
    text = text.replace("offset: [0.42, -0.05, 0]", "offset: [-0.05, 0.42, 0]")
    text = text.replace("rotation_deg: [10, 0, 5]", "rotation_deg: [0, 0, 0]")
    text = text.replace("type: prismatic, axis: y,", "type: prismatic, axis: x,")
    text = text.replace("type: prismatic, axis: -y, limits: [-0.02, 0.08]", "SLIDE")
    text = text.replace("SLIDE", "type: prismatic, axis: -x, limits: [0, 0.1]")
    text = text.replace(",\n            coupled: {to: left_finger, ratio: 1, offset: -0.01}", "")
    body = described(tmp_path, text).body("crane", 1.0)
    bones = body.skeleton
    mirroring = Mirroring.of(bones)
    assert mirroring is not None
    pose = bones.pose(PoseDescription(joints={"left_finger": 0.07, "carriage": 0.1, "arm": 20.0}))
    other = mirroring.mirrored(pose, np.array([1.0, 0.0, 0.0]), np.zeros(3))
    one, two = body.place(pose).transforms, body.place(other).transforms
    counterpart = [0, 1, 2, 4, 3]
    flipped = two[counterpart, :3, 3] * np.array([-1.0, 1.0, 1.0])
    np.testing.assert_allclose(flipped, one[:, :3, 3], atol=1e-9)
