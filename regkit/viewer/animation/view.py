"""The two halves of a picture, and the pinhole cameras that they show."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.system.arrays import Array

FINER = 2
"""How many times finer a picture is drawn before it is shrunk."""

TITLES = ("from the camera", "from the side")

TURN, TILT = np.radians(-72.0), np.radians(9.0)
"""Rotations of the second view about the vertical and the horizontal axis."""

MARGIN = 0.86
"""Part of a half that the body fills over all frames."""

FOOT = 40
"""Height of the strip with the titles below the pictures [px]."""

NEAR = 0.05
"""Points nearer than this part of the middle's distance are not drawn."""


@dataclass(frozen=True)
class Sheet:
    """The size of a picture [px]."""

    width: int
    height: int


@dataclass(frozen=True)
class View:
    """Half of a picture, and the pinhole camera that it shows.

    Attributes:
        title: What is written below it.
        centre: The pixel of the optical axis in the finer picture, (2,).
        focal: Focal length in the finer picture [px].
        T_view_camera: (4, 4) from the depth camera's axes to its own.
    """

    title: str
    centre: Array
    focal: float
    T_view_camera: Array

    def moved(self, points: Array) -> Array:
        """Returns points (N, 3) of the depth camera in this view's axes [m]."""
        return np.asarray(points @ self.T_view_camera[:3, :3].T + self.T_view_camera[:3, 3])

    def pixels(self, points: Array) -> Array:
        """Returns the pixels (N, 2) of points (N, 3) in this view's axes."""
        return np.asarray(self.focal * points[:, :2] / points[:, 2:] + self.centre)


def views(sheet: Sheet, extent: Array) -> tuple[View, View]:
    """Returns a view from the depth camera and one from the side, both as large as fits.

    Args:
        sheet: The size of the picture.
        extent: All points (N, 3) [m] that must be in sight, of all frames.
    """
    low, high = extent.min(axis=0), extent.max(axis=0)
    middle = 0.5 * (low + high)
    size = float(np.linalg.norm(high - low))
    # A cloud of other origin than a camera's is seen from a distance of its own.
    away = middle[2] if middle[2] > size else 2.0 * size
    ahead = np.eye(4)
    ahead[:3, 3] = [-middle[0], -middle[1], away - middle[2]]
    cos, sin = np.cos(TURN), np.sin(TURN)
    about_y = np.array([[cos, 0.0, sin], [0.0, 1.0, 0.0], [-sin, 0.0, cos]])
    cos, sin = np.cos(TILT), np.sin(TILT)
    about_x = np.array([[1.0, 0.0, 0.0], [0.0, cos, -sin], [0.0, sin, cos]])
    aside = np.eye(4)
    aside[:3, :3] = about_x @ about_y
    aside[:3, 3] = [0.0, 0.0, away] - aside[:3, :3] @ middle
    half = np.array([FINER * sheet.width / 2.0, FINER * (sheet.height - FOOT)])
    ends = []
    for placed in (ahead, aside):
        seen = extent @ placed[:3, :3].T + placed[:3, 3]
        flat = seen[:, :2] / np.maximum(seen[:, 2:], NEAR * away)
        ends.append(np.array([flat.min(axis=0), flat.max(axis=0)]))
    # Both halves show the body at one scale.
    focal = min(
        float((MARGIN * half / np.maximum(np.ptp(one, axis=0), 1e-6)).min()) for one in ends
    )
    first, second = (
        View(TITLES[at], half * [0.5 + at, 0.5] - focal * ends[at].mean(axis=0), focal, placed)
        for at, placed in enumerate((ahead, aside))
    )
    return first, second
