"""Where the camera is: random headings, elevations and distances."""

from __future__ import annotations

from dataclasses import dataclass
from math import radians

import numpy as np

from regkit.body import Body
from regkit.geometry.camera import Camera
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import normalized, to_matrix, vector_to_matrix
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError

FACING = np.diag([1.0, -1.0, -1.0])
"""R_camera_body of a body that faces the camera: y up and z to the front."""

STEPS = 60
"""Number of corrections of the camera's place, of which a few are usually enough."""

SWINGING = 20
"""Number of corrections after which they are halved: whole ones may swing about the place."""

INTO = 0.5
"""Sine of the angle by which a camera may look into the opening of a surface: what would go on
there, such as a forearm, hides the body from farther behind."""


@dataclass(frozen=True)
class Views:
    """Distribution of the camera's place around a body.

    An upright body is mostly seen from the front; any other body from anywhere, with all rotations
    alike, except from where its surface is open.

    Attributes:
        frontal: Share of the headings that are normally distributed about the front; the others
            are uniform.
        spread: Standard deviation of those [rad].
        elevation: Least and greatest angle of the camera above the horizon [rad].
        roll: Standard deviation of the camera's roll [rad].
        filling: Least and greatest part of the image's width or height, whichever is filled more.
        nearest: Least distance of any point from the camera, in sizes of the body; where it binds,
            the body fills less of the image.
    """

    frontal: float = 0.7
    spread: float = radians(40.0)
    elevation: tuple[float, float] = (radians(-10.0), radians(30.0))
    roll: float = radians(3.0)
    filling: tuple[float, float] = (0.55, 0.95)
    nearest: float = 0.75

    def sampled(
        self,
        random: np.random.Generator,
        camera: Camera,
        points: Array,
        body: Body,
        opening: Array | None = None,
    ) -> Array:
        """Returns ``T_camera_body`` (4, 4), at which a motion is wholly in the image.

        In every frame the body fills as much of the image as ``filling`` says. A motion that
        reaches farther than that allows fills the image as far as it may.

        Args:
            random: Source of the view.
            camera: The camera.
            points: Points of the surface in the T frames of the motion, (T, N, 3) [m].
            body: The body, for its size, and whether y points up and z to the front.
            opening: Direction (3,) in which the surface is open; None if it is closed.

        Raises:
            ConfigError: If there is no place from which the body fills the image in this way.
        """
        rotation = self._upright(random) if body.upright else _anywhere(random, opening)
        turned = points @ rotation.T
        every = turned.reshape(-1, 3)
        middle = (every.min(axis=0) + every.max(axis=0)) / 2.0
        turned -= middle
        aim, fullness = random.uniform(-1.0, 1.0, size=2), float(random.uniform())
        place = self._place(camera, turned, aim, fullness, self.nearest * body.size)
        return rigid(rotation, place - middle)

    def _upright(self, random: np.random.Generator) -> Array:
        """Returns R_camera_body (3, 3) of an upright body."""
        front, anywhere = random.normal(scale=self.spread), random.uniform(-np.pi, np.pi)
        heading = front if random.uniform() < self.frontal else anywhere
        raised, roll = random.uniform(*self.elevation), random.normal(scale=self.roll)
        turn = vector_to_matrix(np.array([0.0, heading, 0.0]))
        tilt = vector_to_matrix(np.array([raised, 0.0, 0.0]))
        return np.asarray(vector_to_matrix(np.array([0.0, 0.0, roll])) @ FACING @ tilt @ turn)

    def _place(
        self, camera: Camera, points: Array, aim: Array, fullness: float, nearest: float
    ) -> Array:
        """Returns the place (3,) [m] of the middle of the motion.

        Args:
            camera: The camera.
            points: Points (T, N, 3) [m] about the middle of the motion, in camera axes.
            aim: Where the motion is between the borders of the image, from -1 to 1, (2,).
            fullness: How much it fills the image, from 0 to 1 for least to most.
            nearest: Least depth of a point [m].
        """
        size, focal = np.array([camera.width, camera.height]), np.array([camera.fx, camera.fy])
        least, most = self.filling
        extent, front = np.ptp(points, axis=(0, 1)), -float(points[..., 2].min())
        place = np.array([0.0, 0.0, extent[2] + (extent[:2] * focal / size).max()])
        axes = np.ascontiguousarray(np.moveaxis(points, -1, 0))
        for step in range(STEPS):
            share = 1.0 if step < SWINGING else 0.5
            lows, highs = _bounds(camera, axes, place)
            low, high = lows.min(axis=0), highs.max(axis=0)
            filled = float(((high - low) / size).max())
            smallest = float(((highs - lows) / size).max(axis=1).min())
            needed = min(least * filled / smallest, most)
            wanted = needed + fullness * (most - needed)
            free = np.maximum(most * size - 1.0 - (high - low), 0.0) / 2.0
            error = (size - 1.0) / 2.0 + aim * free - (low + high) / 2.0
            depth = front + max((place[2] - front) * filled / wanted, nearest)
            if abs(depth / place[2] - 1.0) < 1e-3 and np.abs(error).max() < 0.1:
                return place
            place[:2] += share * error * place[2] / focal
            place *= 1.0 + share * (depth / place[2] - 1.0)
        raise ConfigError(
            f"there is no place from which a camera of {camera.width} x {camera.height} px, with "
            f"the principal point ({camera.cx:g}, {camera.cy:g}), sees the whole body filling "
            f"{least:g} to {most:g} of its image; take another camera, or let the body fill less"
        )


def _anywhere(random: np.random.Generator, opening: Array | None) -> Array:
    """Returns a rotation (3, 3) that does not look into the opening, with all others alike."""
    while True:
        rotation = to_matrix(normalized(random.normal(size=4)))
        if opening is None or -rotation[2] @ opening <= INTO:
            return rotation


def _bounds(camera: Camera, axes: Array, place: Array) -> tuple[Array, Array]:
    """Returns the least and greatest pixel coordinates (T, 2) of placed points (3, T, N) [m]."""
    x, y, z = axes
    inverse = 1.0 / (z + place[2])
    columns, rows = (x + place[0]) * inverse, (y + place[1]) * inverse
    focal, centre = np.array([camera.fx, camera.fy]), np.array([camera.cx, camera.cy])
    lows = np.column_stack([columns.min(axis=1), rows.min(axis=1)])
    highs = np.column_stack([columns.max(axis=1), rows.max(axis=1)])
    return focal * lows + centre, focal * highs + centre
