"""How the end of a registration moves with the shape: the implicit function theorem.

A tracker ends where F(x, p) = 0: the gradient of the frame's energy, everything bound at the pose x
itself, for shape parameters p. So dx/dp = -(dF/dx)^-1 dF/dp. Both derivatives are differences
(central ones of poses) of the exact gradient of the whole problem, bound anew for each: weights of
visibility and mixture move with the pose and the shape, as they do in the tracker.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from regkit.interfaces import Registrar
from regkit.observation import Observation
from regkit.registration import TangentCoordinates
from regkit.skeleton import Pose
from regkit.system.arrays import Array, Indices

TURN = 1e-3
"""Step of rotations in the differences [rad]; gradients have single precision."""

LEVER = 1.0 / 16.0
"""Length that corresponds to a radian, in sizes of the body."""

PUSH = 1e-4
"""Step down the gradient that shows which limits hold it [rad]."""

ROUNDING = 1e-9
"""Violation of a limit that is rounding [rad]."""

FLOOR = 0.012
"""Curvature at which a direction counts as hardly held by the data, as a fraction of the mean."""


def sensitivity(
    registrar: Registrar,
    varied: Sequence[Registrar],
    by: float,
    observation: Observation,
    pose: Pose,
    markers: Indices,
) -> Array:
    """Returns the displacements (3 M, F) [m] of markers per shape parameter, where a tracker ends.

    Directions that the data hardly hold are damped: their inverse curvature is bounded. Joint
    limits that hold the pose keep holding it.

    Args:
        registrar: The method on the body.
        varied: The method with each shape parameter increased, (F,).
        by: By how much they are increased.
        observation: The frame's data.
        pose: The pose in which the registration has ended.
        markers: Indices of the body's markers, (M,).
    """
    skeleton = registrar.body.skeleton
    coordinates = TangentCoordinates(skeleton, pose)
    at = coordinates.origin()
    units = np.ones(skeleton.dofs)
    if skeleton.free:
        units[:3] = LEVER * registrar.body.size
    steps = coordinates.jacobian(at)
    scale = np.abs(steps).T @ units / np.abs(steps).sum(axis=0)
    steps = steps * scale

    def gradient(one: Registrar, there: Pose) -> Array:
        return np.asarray(steps.T @ one.gradient(observation, there))

    own = gradient(registrar, pose)
    curvature = np.empty((len(at), len(at)))
    for index in range(len(at)):
        step = np.zeros(len(at))
        step[index] = TURN
        ahead, behind = coordinates.pose(step * scale), coordinates.pose(-step * scale)
        change = gradient(registrar, ahead) - gradient(registrar, behind)
        curvature[:, index] = change / (2.0 * TURN)
    forces = np.array([(gradient(more, pose) - own) / by for more in varied]).T
    push = PUSH * own / max(float(np.linalg.norm(own)), 1e-300)
    free = _directions(skeleton.violations(coordinates.pose(-push * scale)), steps)
    left, values, right = np.linalg.svd(free.T @ curvature @ free)
    floor = FLOOR * values.mean() if len(values) else 0.0
    inverse = (right.T * (values / (values**2 + floor**2))) @ left.T
    found = -_marker_rows(registrar, pose, markers) @ steps @ free @ inverse @ free.T @ forces
    return np.asarray(found)


def _directions(violations: tuple[Array, Array], steps: Array) -> Array:
    """Returns an orthonormal basis (m, f) of the steps that no violated limit blocks."""
    violated, jacobian = violations
    rows = jacobian[violated > ROUNDING] @ steps
    rows = rows[np.abs(rows).max(axis=1, initial=0.0) > 0.0]
    if not len(rows):
        return np.eye(steps.shape[1])
    _, values, right = np.linalg.svd(rows)
    rank = int((values > 1e-6 * values[0]).sum())
    return np.asarray(right[rank:].T)


def _marker_rows(registrar: Registrar, pose: Pose, markers: Indices) -> Array:
    """Returns the Jacobian (3 M, n) of marker positions, x, y and z of each in turn."""
    body = registrar.body
    placement = body.place(pose)
    points = body.markers.place(placement.transforms)[markers]
    count = len(markers)
    return placement.rows(
        np.repeat(body.markers.segments[markers], 3),
        np.repeat(points, 3, axis=0),
        np.tile(np.eye(3), (count, 1)),
    )
