"""Tracks as a recorder would have left them, made up: a body that moves, and points on it."""

from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.geometry.camera import Camera
from regkit.observation import Truth
from regkit.primitives import Primitives
from regkit.skeleton import Pose
from regkit.tracking import Track
from regkit.viewer.track_scene import TrackScene

CAMERA = Camera(width=160, height=120, fx=150.0, fy=150.0, cx=79.5, cy=59.5)


@dataclass(frozen=True)
class MadeRegistrar:
    """What a scene asks of a registrar."""

    body: Body
    primitives: Primitives


def made_track(body: Body, frames: int, *, lost: int = 0) -> Track:
    """A body that walks sideways and bends; in its last frames it is lost."""
    rest = body.skeleton.rest()
    root = np.tile(rest.root, (frames, 1, 1))
    root[:, 0, 3], root[:, 2, 3] = 0.01 * np.arange(frames) % 0.5, 3.0
    hinges = np.tile(rest.hinges, (frames, 1)) + 0.3 * np.sin(np.arange(frames))[:, None]
    poses = [Pose(one, rest.balls, angles) for one, angles in zip(root, hinges, strict=True)]
    shares = np.where(np.arange(frames) >= frames - lost, 0.1, 0.95)
    return Track(
        numbers=np.arange(float(frames)),
        times=np.arange(frames) / 30.0,
        root=root,
        balls=np.tile(rest.balls, (frames, 1, 1)),
        hinges=hinges,
        markers=np.array([body.markers.place(body.place(pose).transforms) for pose in poses]),
        surface_distances=0.01 + 0.001 * np.arange(frames),
        inlier_shares=shares,
        coverages=np.ones(frames),
        misfits=np.zeros(frames),
        reliefs=np.ones(frames),
        supports=np.tile(np.linspace(0.0, 1.0, len(body.skeleton.names)), (frames, 1)),
        points=np.full(frames, 100.0),
        energies=np.zeros(frames),
        evaluations=np.ones(frames),
        converged=np.ones(frames),
        seconds=np.full(frames, 0.01),
        preprocessing=np.full(frames, 0.001),
    )


def made_scene(
    body: Body,
    primitives: Primitives,
    frames: int,
    *,
    points: int = 300,
    kept: int = 60,
    lost: int = 0,
) -> TrackScene:
    """The scene of such a track, with points around the origins of its segments."""
    random = np.random.default_rng(3)
    track = made_track(body, frames, lost=lost)
    clouds = {
        int(frame): track.markers[frame][random.integers(len(body.markers.names), size=points)]
        + 0.05 * random.normal(size=(points, 3))
        for frame in np.linspace(0, frames - 1, min(kept, frames)).round().astype(int)
    }
    truth = Truth(body.markers.names, track.markers + 0.01)
    return TrackScene.of(
        track, MadeRegistrar(body, primitives), clouds, fps=30.0, camera=CAMERA, truth=truth,
        errors=np.full(frames, 0.02), marked={frames - 1: "worst"},
    )  # fmt: skip
