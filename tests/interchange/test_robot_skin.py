"""The skin of a robot: what a camera sees of its links, each vertex on one of them."""

from pathlib import Path

import numpy as np
import pytest

from regkit.body import Body
from regkit.geometry.camera import Camera
from regkit.interchange.skeletons import read_skeleton
from regkit.interfaces import Method
from regkit.observation import Frame, Observation
from regkit.sensors.raycast import ray_cast
from regkit.skeleton import Pose
from regkit_plugins.preprocessors.points import PointsPreprocessor

ARM = Path("docs/examples/robots/arm.urdf")

TWO_BOXES = """<robot name="two"><link name="base">
  <visual><origin xyz="0 0 0.1"/><geometry><box size="0.3 0.2 0.2"/></geometry></visual>
  <visual><origin xyz="0 0 0.25"/><geometry><box size="0.1 0.1 0.2"/></geometry></visual>
  <collision><geometry><sphere radius="1"/></geometry></collision>
</link></robot>"""
"""The second box begins inside the first one."""


def test_faces_between_shapes_of_a_link_are_left_out(tmp_path: Path) -> None:
    path = tmp_path / "two.urdf"
    path.write_text(TWO_BOXES)
    skin = read_skeleton(path, up="z", front="x").skin
    assert skin is not None
    # x forward is the body's z, y left its x, and z up its y.
    across, up, along = skin.vertices[skin.faces].mean(axis=1).T
    inner = (np.abs(along) < 0.0499) & (np.abs(across) < 0.0499)
    assert not (inner & (up > 0.005) & (up < 0.345)).any()
    assert (inner & (np.abs(up - 0.35) < 1e-9)).any()
    # The area is that of both boxes, without the overlap and the face that the second one covers.
    edges = skin.vertices[skin.faces][:, 1:] - skin.vertices[skin.faces][:, :1]
    area = 0.5 * np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1).sum()
    whole = 2 * (0.3 * 0.2 + 0.3 * 0.2 + 0.2 * 0.2) - 0.01 + 0.01 + 4 * 0.1 * 0.15
    assert area == pytest.approx(whole, rel=0.03)


def test_normals_are_those_of_the_sides(tmp_path: Path) -> None:
    path = tmp_path / "two.urdf"
    path.write_text(TWO_BOXES)
    imported = read_skeleton(path)
    body = _body(tmp_path, imported)
    assert body.surface is not None
    normals = body.surface.normals[:, 0]
    np.testing.assert_allclose(np.sort(np.abs(normals), axis=1)[:, :2], 0.0, atol=1e-6)
    outward = (normals * (body.surface.points[:, 0] - [0.0, 0.15, 0.0])).sum(axis=1)
    assert (outward > 0.0).mean() > 0.97


@pytest.fixture(scope="module")
def arm(tmp_path_factory: pytest.TempPathFactory) -> Body:
    return _body(tmp_path_factory.mktemp("arm"), read_skeleton(ARM))


def test_every_link_has_enough_vertices_for_its_size(arm) -> None:
    counts = np.bincount(arm.surface.segments[:, 0], minlength=len(arm.skeleton.names))
    assert counts.min() > 100
    assert 2000 < counts.sum() < 10_000


def test_an_arm_on_a_rail_is_registered_to_a_depth_image(arm) -> None:
    bones = arm.skeleton
    positions = {"carriage": 0.1, "shoulder": 0.4, "upper_arm": 0.5, "elbow": -0.6}
    positions |= {"forearm": 0.3, "wrist": 0.5, "palm": 0.2, "left_finger": 0.03}
    hinges = np.array([positions.get(name, 0.0) for name in bones.hinge_names])
    root = np.eye(4)
    root[:3] = [[0.8, 0.0, 0.6, 0.0], [0.0, -1.0, 0.0, 0.3], [0.6, 0.0, -0.8, 1.4]]
    truth = Pose(root, np.zeros((0, 4)), bones.limits.couplings.coupled(hinges))
    random = np.random.default_rng(0)
    step = 0.03 * random.normal(size=bones.dofs)
    start = bones.limits.projected(bones.retract(truth, step))
    found = Method.parse("robots", place="test", field="method").bind(arm)
    pose = found.register(_seen(arm, truth), [start]).pose
    off = bones.difference(truth, pose)
    # The tool is some twenty pixels wide here, and the elbow's roll turns little else.
    tool = np.concatenate([bones.dofs_of(name) for name in ("forearm", "wrist", "palm")])
    fingers = np.concatenate([bones.dofs_of(name) for name in ("left_finger", "right_finger")])
    slides = np.array([0, 1, 2, *bones.dofs_of("carriage")])
    turns = np.setdiff1d(np.arange(bones.dofs), [*slides, *tool, *fingers])
    assert np.abs(off[slides]).max() < 0.003
    assert np.degrees(np.abs(off[turns])).max() < 2.0
    assert np.degrees(np.abs(off[tool])).max() < 10.0
    assert np.abs(off[fingers]).max() < 0.02


def _body(folder: Path, imported) -> Body:
    mesh = folder / "robot_mesh.npz"
    imported.skin.write(mesh)
    description = imported.description.model_copy(update={"mesh": mesh})
    return description.body("robot", description.size.value)


def _seen(body: Body, pose: Pose) -> Observation:
    camera = Camera(width=320, height=240, fx=290.0, fy=290.0, cx=159.5, cy=119.5)
    depth = ray_cast(body.surface.place(body.place(pose).transforms), body.surface.faces, camera)
    hit = depth > 0.0
    depth[hit] += 0.002 * np.random.default_rng(1).standard_normal(int(hit.sum()))
    frame = Frame(camera.back_projected(depth), camera, depth)
    return PointsPreprocessor(voxel=0.012, sigma=0.005).preprocess(frame)
