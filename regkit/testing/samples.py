"""Samples for the laws: two small bodies, and data near them."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np

from regkit.alignment import cloud_body
from regkit.body import Body, BodyDescription
from regkit.clouds import normals as fitted_normals
from regkit.config.document import Document
from regkit.geometry.camera import Camera
from regkit.geometry.rigid import rigid, transformed
from regkit.geometry.rotation import vector_to_matrix
from regkit.geometry.surface import SkinnedSurface
from regkit.observation import Landmarks, Observation
from regkit.skeleton import Pose
from regkit.system.arrays import Array

LINKAGE = Path(__file__).with_name("linkage.yaml")
CAMERA = Camera(width=176, height=144, fx=230.0, fy=230.0, cx=87.5, cy=71.5)
"""Its principal point is its centre: a half turn about its axis maps pixels to pixels."""
RINGS, SPOKES = 4, 6
"""Number of vertices of a capsule's skin, along the axis and around it."""
BLENDED = 0.25
"""Blending weight of the parent in the first ring of a child segment's skin."""


@lru_cache
def linkage() -> Body:
    """Returns a body of six segments with every type of joint, capsules, and a skin."""
    body = Document.read(LINKAGE).validated(BodyDescription).body("linkage", 1.2)
    return replace(body, surface=_skin(body))


@lru_cache
def lump() -> Body:
    """Returns a rigid body of 300 points on a closed, asymmetric surface of about 0.4 m."""
    return cloud_body("lump", lump_points(300))


def lump_points(count: int, seed: int = 3) -> Array:
    """Returns points on the lump's surface, (count, 3) [m]."""
    directions = np.random.default_rng(seed).normal(size=(count, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    x, y, z = directions.T
    radii = 1.0 + 0.3 * np.sin(3.0 * x + 1.0) * y + 0.35 * np.cos(2.0 * z) * x + 0.2 * y * z
    return np.asarray(0.1 * radii[:, None] * directions * [1.6, 1.0, 0.7])


def posed(body: Body, random: np.random.Generator, spread: float = 0.4) -> Pose:
    """Returns a random pose in front of the camera, with joints of about ``spread`` [rad]."""
    bones = body.skeleton
    root = rigid(vector_to_matrix(random.normal(size=3)), np.array([0.2, -0.1, 2.0]))
    pose = bones.retract(bones.rest(root), spread * random.normal(size=bones.dofs))
    return bones.limits.projected(pose)


def data_of(
    body: Body, pose: Pose, random: np.random.Generator, noise: float = 0.02
) -> Observation:
    """Returns data of a posed body: uneven weights, two variances, normals and a camera.

    Nothing in it is isotropic, so that a wrong torque cannot go unnoticed.
    """
    assert body.surface is not None
    surface = body.surface.place(body.place(pose).transforms)
    chosen = random.integers(len(surface), size=140)
    points = surface[chosen] + noise * random.normal(size=(140, 3)) * [1.5, 1.0, 0.5]
    normals = random.normal(size=(140, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    depth = np.zeros((CAMERA.height, CAMERA.width))
    depth[40:100, 90:120] = 2.1  # A silhouette that partly covers the body.
    return Observation(
        points=points,
        weights=random.uniform(0.5, 2.0, 140),
        variances=random.choice([0.01, 0.03], size=140) ** 2,
        camera=CAMERA,
        depth=depth,
        normals=normals,
        landmarks=landmarks_of(body, pose, random),
    )


def landmarks_of(body: Body, pose: Pose, random: np.random.Generator) -> Landmarks:
    """Returns landmarks of a posed body: every other one in the picture only, some centimetres off.

    Their confidences are uneven.
    """
    names = body.markers.names
    places = body.markers.place(body.place(pose).transforms)
    places = places + random.normal(scale=[0.05, 0.03, 0.02], size=places.shape)
    pixels = CAMERA.projected(np.maximum(places, [-np.inf, -np.inf, 0.1]))
    places[::2] = np.nan
    return Landmarks(names, places, pixels, random.uniform(0.3, 1.0, len(names)))


def surface_data(body: Body, pose: Pose, sigma: float = 0.01) -> Observation:
    """Returns a body's surface in a pose as data, without noise and seen from all sides."""
    assert body.surface is not None
    points = body.surface.place(body.place(pose).transforms)
    count = len(points)
    return Observation(
        points,
        np.ones(count),
        np.full(count, sigma**2),
        normals=fitted_normals(points),
        landmarks=exact_landmarks(body, pose),
    )


def exact_landmarks(body: Body, pose: Pose) -> Landmarks:
    """Returns the markers of a posed body as landmarks in space."""
    places = body.markers.place(body.place(pose).transforms)
    return Landmarks.in_space(body.markers.names, places)


def moved_data(data: Observation, motion: Array) -> Observation:
    """Returns data after a rigid motion (4, 4), without its picture, which cannot move."""
    normals = None if data.normals is None else data.normals @ motion[:3, :3].T
    marks = data.landmarks
    if marks is not None:
        places = transformed(motion, marks.positions)
        marks = Landmarks.in_space(marks.names, places, marks.confidences)
    points = transformed(motion, data.points)
    return replace(data, points=points, normals=normals, depth=None, landmarks=marks)


def moved_pose(pose: Pose, motion: Array) -> Pose:
    """Returns a pose after a rigid motion (4, 4) of the whole body."""
    return Pose(motion @ pose.root, pose.balls, pose.hinges)


def _skin(body: Body) -> SkinnedSurface:
    """Returns rings around the capsules; the first ones of a segment also follow its parent."""
    transforms = body.place(body.skeleton.rest()).transforms
    parents = np.where(body.skeleton.parents < 0, 0, body.skeleton.parents)
    capsules = body.capsules.place(transforms)
    around = np.linspace(0.0, 2.0 * np.pi, SPOKES, endpoint=False)
    vertices: list[Array] = []
    normals: list[Array] = []
    bones, blend, faces = [], [], []
    for segment, (start, end), radii in zip(
        capsules.segments, capsules.ends, capsules.radii, strict=True
    ):
        unit = (end - start) / np.linalg.norm(end - start)
        side = np.cross(unit, np.eye(3)[np.abs(unit).argmin()])
        side /= np.linalg.norm(side)
        out = np.outer(np.cos(around), side) + np.outer(np.sin(around), np.cross(unit, side))
        first = len(vertices) * SPOKES
        for ring, along in enumerate(np.linspace(0.0, 1.0, RINGS)):
            radius = (1.0 - along) * radii[0] + along * radii[1]
            vertices.append((1.0 - along) * start + along * end + radius * out)
            normals.append(out)
            share = BLENDED if ring == 0 and body.skeleton.parents[segment] >= 0 else 0.0
            bones.append(np.tile([segment, parents[segment]], (SPOKES, 1)))
            blend.append(np.tile([1.0 - share, share], (SPOKES, 1)))
        faces += [(first + a, first + b, first + c) for a, b, c in _tube()]
    carriers = np.concatenate(bones)
    inverse = np.linalg.inv(transforms)[carriers]
    turns, shifts = inverse[..., :3, :3], inverse[..., :3, 3]
    return SkinnedSurface(
        segments=carriers,
        points=np.einsum("vaij,vj->vai", turns, np.concatenate(vertices)) + shifts,
        blend=np.concatenate(blend),
        normals=np.einsum("vaij,vj->vai", turns, np.concatenate(normals)),
        faces=np.array(faces, dtype=np.intp),
    )


def _tube() -> list[tuple[int, int, int]]:
    """Returns the triangles between the rings of a capsule, oriented outward."""
    triangles = []
    for ring in range(RINGS - 1):
        for spoke in range(SPOKES):
            a, b = ring * SPOKES + spoke, ring * SPOKES + (spoke + 1) % SPOKES
            triangles += [(a, b, a + SPOKES), (b, b + SPOKES, a + SPOKES)]
    return triangles
