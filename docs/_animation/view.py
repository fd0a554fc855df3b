"""The two halves of the picture, and the pinhole cameras that they show."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.system.arrays import Array

WIDTH, HEIGHT, FINER = 800, 470, 2
"""Size of the picture [px], and how many times finer it is drawn."""


@dataclass(frozen=True)
class View:
    """Half of the picture, and the pinhole camera that it shows.

    Attributes:
        title: What is written below it.
        left: Its first column [px].
        T_view_camera: (4, 4) from the depth camera's axes to its own.
        focal: Focal length [px].
    """

    title: str
    left: float
    T_view_camera: Array
    focal: float = 690.0

    def moved(self, points: Array) -> Array:
        """Points (N, 3) of the depth camera in this view's axes [m]."""
        return np.asarray(points @ self.T_view_camera[:3, :3].T + self.T_view_camera[:3, 3])

    def pixels(self, points: Array) -> Array:
        """Where points (N, 3) in this view's axes are in the picture (N, 2) [px]."""
        middle = FINER * np.array([self.left + WIDTH / 4.0, HEIGHT / 2.0 - 20.0])
        return np.asarray(FINER * self.focal * points[:, :2] / points[:, 2:] + middle)


def views(middle: Array) -> tuple[View, View]:
    """From the depth camera, and from the person's side; both look at ``middle`` (3,) [m]."""
    ahead = np.eye(4)
    ahead[:2, 3] = -middle[:2]
    turn, tilt = np.radians(-72.0), np.radians(9.0)
    about_y = np.array(
        [[np.cos(turn), 0, np.sin(turn)], [0, 1, 0], [-np.sin(turn), 0, np.cos(turn)]]
    )
    about_x = np.array(
        [[1, 0, 0], [0, np.cos(tilt), -np.sin(tilt)], [0, np.sin(tilt), np.cos(tilt)]]
    )
    aside = np.eye(4)
    aside[:3, :3] = about_x @ about_y
    aside[:3, 3] = [0.0, 0.0, middle[2]] - aside[:3, :3] @ middle
    return View("from the camera", 0.0, ahead), View("from the side", WIDTH / 2.0, aside)
