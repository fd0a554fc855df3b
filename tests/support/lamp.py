"""A desk lamp with two joints, posed and seen by a depth camera: a body that is found quickly."""

import numpy as np

from regkit.body import Body
from regkit.geometry.camera import Camera
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.observation import Frame, Observation
from regkit.skeleton import Pose, PoseDescription
from regkit_plugins.preprocessors.points import PointsPreprocessor

CAMERA = Camera(width=96, height=80, fx=110.0, fy=110.0, cx=47.5, cy=39.5)

LAMP = """
title: A desk lamp, no two parts of which are alike.
size: {name: height, value: 1.0, range: [0.8, 1.25]}
upright: true
segments:
  foot:
    joint: {type: free}
    capsules:
      - {start: [-0.15, 0, 0], end: [0.25, 0, 0], radius: [0.08, 0.05]}
    markers: {heel: [-0.15, 0, 0], toe: [0.25, 0, 0]}
  arm:
    parent: foot
    offset: [0, 0.05, 0]
    joint: {type: hinge, axis: z, limits_deg: [-60, 60]}
    capsules: [{start: [0, 0, 0], end: [0, 0.5, 0], radius: [0.04, 0.05]}]
    markers: {elbow: [0, 0.5, 0]}
  head:
    parent: arm
    offset: [0, 0.5, 0]
    joint: {type: hinge, axis: z, limits_deg: [-120, 0]}
    capsules: [{start: [0, 0, 0], end: [0, 0.35, 0], radius: [0.04, 0.1]}]
    markers: {bulb: [0, 0.35, 0]}
stances:
  bowed: {joints: {head: -60}}
"""


def seen(body: Body, pose: Pose, *, image: bool = False) -> Observation:
    """What a depth camera sees of a body: along each ray, steps as long as the surface is far.

    With the image, nothing but free space is beside the body, and nothing is known elsewhere.
    """
    surface = body.capsules.place(body.place(pose).transforms)
    rays = CAMERA.rays().reshape(-1, 3)
    rays = rays / np.linalg.norm(rays, axis=1, keepdims=True)
    along = np.full(len(rays), 0.5)
    for _ in range(60):
        along += surface.surface_distance(along[:, None] * rays)
        along = np.minimum(along, 10.0)
    points = along[:, None] * rays
    hit = np.abs(surface.surface_distance(points)) < 1e-3
    depth = np.where(hit, points[:, 2], 0.0).reshape(CAMERA.height, CAMERA.width)
    frame = Frame(points[hit], CAMERA, depth if image else None)
    return PointsPreprocessor(sigma=0.02).preprocess(frame)


def facing(body: Body, turn: float, joints: dict[str, float]) -> Pose:
    """The body 2.5 m before the camera, turned about the upright [rad]."""
    bones = body.skeleton
    pose = bones.pose(PoseDescription(joints=joints))
    rotation = np.diag([1.0, -1.0, -1.0]) @ vector_to_matrix(np.array([0.0, turn, 0.0]))
    root = rigid(rotation, np.array([0.1, 0.35, 2.5]))
    return Pose(root, pose.balls, pose.hinges)
