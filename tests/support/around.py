"""Frames of one body in cameras around it."""

import numpy as np

from regkit.body.depth import depth_image
from regkit.geometry.camera import Camera
from regkit.geometry.rigid import inverse, rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.observation import Frame, View

CAMERA = Camera(88, 72, 90.0, 90.0, 44.0, 36.0)


def facing(body, distance=1.7, turn=0.0):
    """The rest pose before a camera at the origin, upright and turned, in units of the size."""
    upright = np.diag([1.0, -1.0, -1.0]) @ vector_to_matrix(np.array([0.0, turn, 0.0]))
    place = np.array([0.05, 0.1, distance]) * body.size
    return body.skeleton.rest(rigid(upright, place))


def around(middle, angle):
    """T_world_camera of a camera at the origin, moved about the vertical through a point (3,)."""
    turn = vector_to_matrix(np.array([0.0, angle, 0.0]))
    return rigid(turn, middle - turn @ middle)


def view_of(body, pose, T_world_camera, name="camera", camera=CAMERA):
    """The exact depth image of a body in the world."""
    depth = depth_image(body, pose.moved(inverse(T_world_camera)), camera)
    depth = np.where(np.isfinite(depth), depth, 0.0)
    frame = Frame(camera.back_projected(depth), camera, depth)
    return View(name, T_world_camera, frame)


def frame_around(body, pose, angles, camera=CAMERA):
    """The frame of cameras around a body, the first at the world's origin if its angle is zero."""
    middle = pose.root[:3, 3]
    views = [
        view_of(body, pose, around(middle, angle), f"camera_{index}", camera)
        for index, angle in enumerate(angles)
    ]
    return Frame.of_views(views)
