"""Exported motion: what other programs read is where the body was."""

import csv
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from regkit.body import Body
from regkit.geometry.capsules import Capsules
from regkit.geometry.rigid import rigid
from regkit.geometry.skinned_mesh import SkinnedMesh
from regkit.geometry.surface import SkinnedSurface
from regkit.interchange.bvh.bvh import Bvh
from regkit.interchange.bvh.euler import continuous_zyx
from regkit.interchange.bvh.motion import bvh_of
from regkit.interchange.csv_motion import COLUMNS
from regkit.interchange.gltf.capsule_mesh import capsule_mesh
from regkit.interchange.gltf.gltf import RiggedBody
from regkit.interchange.motion import TrackedMotion
from regkit.interchange.motions import write_motion
from tests.support.two_lamps import PLACES, described, lamps_at

UPRIGHT = np.diag([1.0, -1.0, -1.0])
"""From a camera's axes (y down, z forward) to a scene's (y up, z backward)."""


@pytest.fixture
def motion(linkage: Body, random: np.random.Generator) -> TrackedMotion:
    """Poses of the linkage, which has segments at an angle and every type of joint."""
    pose = linkage.skeleton.rest(rigid(Rotation.random(rng=random).as_matrix(), np.ones(3)))
    transforms, hinges = [], []
    for _ in range(6):
        pose = linkage.skeleton.retract(pose, random.normal(0.0, 0.7, linkage.skeleton.dofs))
        transforms.append(linkage.place(pose).transforms)
        hinges.append(pose.hinges)
    return TrackedMotion(
        "direct linkage", linkage, np.array(transforms), np.array(hinges), 25.0, None
    )


@pytest.mark.parametrize("scale", [1.0, 0.01])
def test_bvh_is_read_back_where_the_joints_were(
    tmp_path: Path, motion: TrackedMotion, scale: float
) -> None:
    path = tmp_path / "motion.bvh"
    write_motion(motion, path, scale=scale)
    again = Bvh.read(path, scale=scale)
    names = motion.body.skeleton.names
    assert sorted(again.names) == sorted(names)
    assert again.frame_time == pytest.approx(0.04)
    rest = motion.body.place(motion.body.skeleton.rest()).transforms
    for frame, transforms in enumerate(motion.transforms):
        pose = again.at_frame(frame)
        for joint, name in enumerate(again.names):
            segment = names.index(name)
            where = UPRIGHT @ transforms[segment, :3, 3]
            np.testing.assert_allclose(pose.positions[joint], where, rtol=1e-6, atol=1e-8)
            turn = UPRIGHT @ transforms[segment, :3, :3] @ rest[segment, :3, :3].T
            np.testing.assert_allclose(pose.rotations[joint], turn, atol=1e-8)
    (foot,) = again.joints[again.names.index("leg")].ends
    points = motion.body.markers.points[motion.body.markers.names.index("foot")]
    np.testing.assert_allclose(foot, points, atol=1e-9)


def test_bvh_has_bodies_that_are_free_in_a_scene_where_they_were(
    tmp_path: Path, random: np.random.Generator
) -> None:
    """Each of two lamps has a translation of its own in the file."""
    body = described().body("lamps", 1.0)
    pose, transforms, hinges = lamps_at(body, PLACES), [], []
    for _ in range(4):
        pose = body.skeleton.retract(pose, 0.3 * random.normal(size=body.skeleton.dofs))
        transforms.append(body.place(pose).transforms)
        hinges.append(pose.hinges)
    path = tmp_path / "motion.bvh"
    poses = np.array(transforms)
    write_motion(TrackedMotion("lamps", body, poses, np.array(hinges), 25.0, None), path)
    names = body.skeleton.names
    again = Bvh.read(path, scale=1.0)
    places = np.array([again.at_frame(frame).positions for frame in range(4)])
    order = [names.index(name) for name in again.names]
    np.testing.assert_allclose(places, poses[..., :3, 3][:, order] @ UPRIGHT.T, atol=1e-7)


def test_bvh_angles_do_not_jump_by_full_turns(random: np.random.Generator) -> None:
    # A smooth motion through several full turns, and through the pole of the middle angle.
    times = np.linspace(0.0, 1.0, 400)
    wanted = np.stack([9.0 * times, 0.5 * np.pi * np.sin(7.0 * times), -8.0 * times], axis=1)
    turns = Rotation.from_euler("ZYX", wanted).as_matrix()
    angles = continuous_zyx(turns)
    np.testing.assert_allclose(Rotation.from_euler("ZYX", angles).as_matrix(), turns, atol=1e-9)
    np.testing.assert_allclose(angles, wanted, atol=0.05)
    assert np.abs(np.diff(angles, axis=0)).max() < 0.1


def test_where_two_axes_fall_together_the_rotation_is_still_kept() -> None:
    wanted = [[0.3, 0.5 * np.pi, 0.2], [0.1, -0.5 * np.pi, -0.7], [0.0, 0.5 * np.pi, 3.0]]
    turns = Rotation.from_euler("ZYX", wanted).as_matrix()
    angles = continuous_zyx(turns)
    np.testing.assert_allclose(Rotation.from_euler("ZYX", angles).as_matrix(), turns, atol=1e-9)


def test_csv_has_every_segment_and_marker_in_the_cameras_frame(
    tmp_path: Path, motion: TrackedMotion
) -> None:
    write_motion(motion, tmp_path / "motion.csv")
    with (tmp_path / "motion.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert tuple(rows[0]) == COLUMNS
    names, markers = motion.body.skeleton.names, motion.body.markers
    hinges = motion.body.skeleton.hinge_names
    assert len(rows) == len(motion.transforms) * (len(names) + len(markers.names) + len(hinges))
    for row in rows:
        frame, name = int(row["frame"]), row["name"]
        assert float(row["time"]) == pytest.approx(frame / 25.0)
        if row["kind"] == "hinge":
            angle = motion.hinges[frame, hinges.index(name)]
            assert float(row["angle_rad"]) == pytest.approx(angle, abs=1e-7)
            assert row["x"] == row["qw"] == ""
            continue
        assert row["angle_rad"] == ""
        place = [float(row[axis]) for axis in "xyz"]
        if row["kind"] == "marker":
            where = markers.place(motion.transforms[frame])[markers.names.index(name)]
            assert {row[f"q{axis}"] for axis in "xyzw"} == {""}
        else:
            transform = motion.transforms[frame, names.index(name)]
            where = transform[:3, 3]
            turn = Rotation.from_quat([float(row[f"q{axis}"]) for axis in "xyzw"])
            np.testing.assert_allclose(turn.as_matrix(), transform[:3, :3], atol=1e-7)
        np.testing.assert_allclose(place, where, atol=1e-7)


def _skin(body: Body, random: np.random.Generator) -> SkinnedMesh:
    """A mesh whose rest pose is not the body's, and whose bones stand in another order."""
    skeleton = body.skeleton
    pose = skeleton.retract(skeleton.rest(), random.normal(0.0, 0.5, skeleton.dofs))
    rest = body.place(pose).transforms
    order = [0, *(1 + random.permutation(len(rest) - 1))]
    weights = random.random((90, 5))
    return SkinnedMesh(
        vertices=random.normal(0.0, 0.3, (90, 3)),
        faces=np.arange(90).reshape(-1, 3),
        labels=tuple(skeleton.names[index] for index in order),
        parents=np.full(len(order), -1),
        rest=rest[order],
        indices=random.integers(0, len(order), (90, 5)),
        weights=weights / weights.sum(axis=1, keepdims=True),
    )


def test_gltf_is_read_back_where_the_skin_was(
    tmp_path: Path, motion: TrackedMotion, random: np.random.Generator
) -> None:
    skin = _skin(motion.body, random)
    names = motion.body.skeleton.names
    surface = SkinnedSurface.of(skin)
    order = np.array([names.index(label) for label in skin.labels])
    surface = replace(surface, segments=order[surface.segments])
    write_motion(replace(motion, skin=skin), tmp_path / "motion.glb")
    body = RiggedBody.read(tmp_path / "motion.glb")
    (clip,) = body.clips
    assert clip.name == "direct linkage"
    assert set(body.mesh.labels) == set(names)
    np.testing.assert_allclose(clip.times, motion.times, atol=1e-6)
    for time, transforms in zip(clip.times, motion.transforms, strict=True):
        np.testing.assert_allclose(
            body.mesh.posed(clip.at(time)), surface.place(transforms) @ UPRIGHT, atol=1e-5
        )


def test_a_body_without_a_skin_shows_its_capsules(tmp_path: Path, motion: TrackedMotion) -> None:
    write_motion(motion, tmp_path / "motion.glb")
    body = RiggedBody.read(tmp_path / "motion.glb")
    for time, transforms in zip(body.clips[0].times, motion.transforms, strict=True):
        points = body.mesh.posed(body.clips[0].at(time)) @ UPRIGHT
        placed = motion.body.capsules.place(transforms)
        # Capsules overlap, so that a point of one may be inside another, but never outside all.
        distances = np.stack(
            [
                placed.selected(np.arange(len(placed)) == k).surface_distance(points)
                for k in range(len(placed))
            ]
        )
        assert np.abs(distances).min(axis=0).max() < 1e-5


def test_a_body_without_any_shape_shows_its_joints(tmp_path: Path, motion: TrackedMotion) -> None:
    empty = Capsules(np.zeros(0, dtype=np.intp), np.zeros((0, 2, 3)), np.zeros((0, 2)))
    bare = replace(motion, body=replace(motion.body, capsules=empty))
    write_motion(bare, tmp_path / "motion.glb")
    body = RiggedBody.read(tmp_path / "motion.glb")
    points = body.mesh.posed(body.clips[0].at(0.0)) @ UPRIGHT
    joints = motion.transforms[0, :, :3, 3]
    gaps = np.linalg.norm(points[:, None] - joints, axis=2)
    np.testing.assert_allclose(gaps.min(axis=1), 0.02 * motion.body.size, atol=1e-5)
    assert set(gaps.argmin(axis=1)) == set(range(len(joints)))


def test_triangles_of_a_capsule_are_closed_and_face_outward(random: np.random.Generator) -> None:
    ends = random.normal(size=(4, 2, 3))
    radii = np.array([[0.3, 0.1], [0.2, 0.2], [0.1, 0.4], [9.0, 0.1]])
    ends[1, 1] = ends[1, 0]
    vertices, faces, owners = capsule_mesh(Capsules(np.arange(4), ends, radii))
    for index in range(4):
        own = faces[owners[faces[:, 0]] == index]
        corners = vertices[own]
        volume = np.linalg.det(corners - ends[index].mean(axis=0)).sum() / 6.0
        a, b = radii[index]
        length = np.linalg.norm(ends[index, 1] - ends[index, 0])
        if index in (1, 3):
            expected = 4.0 / 3.0 * np.pi * max(a, b) ** 3
        else:
            # Two balls' caps and the frustum between their seams.
            sine = (a - b) / length
            cosine = np.sqrt(1.0 - sine**2)
            height = length - (a - b) * sine
            frustum = np.pi / 3.0 * height * cosine**2 * (a * a + a * b + b * b)
            caps = [
                np.pi / 3.0 * r**3 * (2.0 + s) * (1.0 - s) ** 2 for r, s in ((a, -sine), (b, sine))
            ]
            expected = frustum + sum(caps)
        assert volume == pytest.approx(expected, rel=0.06)
        assert volume < expected


def test_names_with_blanks_are_one_word_in_bvh(motion: TrackedMotion) -> None:
    skeleton = motion.body.skeleton
    names = tuple(name.replace("leg", "left leg") for name in skeleton.names)
    body = replace(motion.body, skeleton=replace(skeleton, names=names))
    assert "left_leg" in bvh_of(replace(motion, body=body)).names


def test_names_that_bvh_cannot_have_are_read_back_unlike_each_other(
    tmp_path: Path, motion: TrackedMotion
) -> None:
    skeleton = motion.body.skeleton
    names = ("left {arm}", "left__arm_", "left\tfoot", *skeleton.names[3:])
    body = replace(motion.body, skeleton=replace(skeleton, names=names))
    write_motion(replace(motion, body=body), tmp_path / "motion.bvh")
    again = Bvh.read(tmp_path / "motion.bvh").names
    assert sorted(again) == sorted(["left__arm__", "left__arm_", "left_foot", *names[3:]])
