"""A pole with an arm whose hand has two fingers in another template: a small composed body."""

import numpy as np
import yaml

from regkit.body import Body, BodyDescription
from regkit.body.composition import Composition, Sized
from regkit.body.members import Member
from regkit.geometry.camera import Camera
from regkit.geometry.rigid import rigid
from regkit.observation import Frame, Observation
from regkit.skeleton import Pose, PoseDescription
from regkit_plugins.preprocessors.points import PointsPreprocessor

POLE = """
title: A pole with a bar and an arm.
size: {name: height, value: 1.0, range: [0.8, 1.25]}
upright: true
segments:
  pole:
    joint: {type: free}
    capsules:
      - {start: [0, -0.5, 0], end: [0, 0.4, 0], radius: [0.09, 0.06]}
      - {start: [-0.3, 0.2, 0], end: [0, 0.2, 0], radius: 0.05}
    markers: {foot: [0, -0.5, 0], top: [0, 0.4, 0], bar: [-0.3, 0.2, 0]}
  arm:
    parent: pole
    offset: [0.05, 0.2, 0]
    joint: {type: hinge, axis: z, limits_deg: [-80, 80]}
    capsules: [{start: [0, 0, 0], end: [0.35, 0, 0], radius: [0.05, 0.04]}]
    markers: {elbow: [0.05, 0, 0]}
  hand:
    parent: arm
    offset: [0.38, 0, 0]
    capsules: [{start: [0, 0, 0], end: [0.18, 0, 0], radius: [0.04, 0.02]}]
    markers: {wrist: [0, 0, 0]}
sockets:
  hand:
    rotation_deg: [0, 0, -90]
    joint: {type: hinge, axis: z, limits_deg: [-60, 60]}
    size: 0.2
"""

GRIPPER = """
title: A palm with two fingers.
size: {name: length, value: 0.2, range: [0.1, 0.4]}
segments:
  palm:
    joint: {type: free}
    capsules: [{start: [0, 0, 0], end: [0, 0.07, 0], radius: 0.035}]
    markers: {palm: [0, 0, 0]}
  thumb:
    parent: palm
    offset: [0.03, 0.06, 0]
    joint: {type: hinge, axis: z, limits_deg: [-60, 30]}
    capsules: [{start: [0, 0, 0], end: [0, 0.14, 0], radius: [0.02, 0.013]}]
    markers: {thumb_tip: [0, 0.14, 0]}
  finger:
    parent: palm
    offset: [-0.03, 0.06, 0]
    joint: {type: hinge, axis: z, limits_deg: [-30, 60]}
    capsules: [{start: [0, 0, 0], end: [0, 0.16, 0], radius: [0.02, 0.013]}]
    markers: {finger_tip: [0, 0.16, 0]}
stances:
  spread: {joints: {thumb: -40, finger: 40}}
"""

CAMERA = Camera(width=240, height=200, fx=280.0, fy=280.0, cx=119.5, cy=99.5)


def scarecrow() -> Body:
    """The pole whose hand is the gripper, called ``hand``."""
    pole, gripper = (
        BodyDescription.model_validate(yaml.safe_load(text)) for text in (POLE, GRIPPER)
    )
    base = Sized(Member("body", pole), lambda: pole.body("pole", 1.0))
    hand = Member("hand", gripper, "hand_", at="hand")
    part = Sized(hand, lambda: gripper.body("gripper", 0.2))
    return Composition([base], [part]).body("scarecrow")


def standing(body: Body, distance: float = 2.0, **joints: float) -> Pose:
    """The scarecrow upright before the camera at a distance [m], with joints at angles [deg]."""
    pose = body.skeleton.pose(PoseDescription(joints=dict(joints)))
    root = rigid(np.diag([1.0, -1.0, -1.0]), np.array([-0.1, 0.05, distance]))
    return Pose(root, pose.balls, pose.hinges)


def measured(body: Body, pose: Pose, voxel: float = 0.012) -> Observation:
    """What a depth camera sees of the body in a pose, in fine voxels."""
    surface = body.capsules.place(body.place(pose).transforms)
    rays = CAMERA.rays().reshape(-1, 3)
    rays = rays / np.linalg.norm(rays, axis=1, keepdims=True)
    along = np.full(len(rays), 0.5)
    for _ in range(60):
        along = np.minimum(along + surface.surface_distance(along[:, None] * rays), 10.0)
    points = along[:, None] * rays
    hit = np.abs(surface.surface_distance(points)) < 1e-3
    depth = np.where(hit, points[:, 2], 0.0).reshape(CAMERA.height, CAMERA.width)
    frame = Frame(points[hit], CAMERA, depth)
    return PointsPreprocessor(voxel=voxel, sigma=0.006).preprocess(frame)
