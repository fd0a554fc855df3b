"""The digest of everything that a rendered recording depends on."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict

import numpy as np

from regkit.sensors.noise import noise_of
from regkit_synthesis.recordings.scene import Scene

RENDERER = 1
"""Version of the renderer, incremented with every change that changes images."""


def digest(scene: Scene, seed: int, noise_stream: str | None = None) -> str:
    """Returns half of the SHA-256 of a scene, and of the seed and stream of its noise.

    The digest covers the rendered content rather than the configuration: vertices, skinning, and
    bone poses in each frame. So it changes with the files of body and motion, with the map between
    them, and with the retargeting code.
    """
    sensor, landmarks = scene.sensor, scene.landmarks.values()
    told = [RENDERER, seed, scene.name, scene.source, scene.licence, scene.fps]
    told += [asdict(sensor.camera), sensor.depth_scale, noise_of(sensor.noise).model_dump()]
    told += [scene.joints, dict(scene.markers), [mark.bone for mark in landmarks]]
    if noise_stream is not None:
        told.append(noise_stream)
    if scene.room:
        told += [list(scene.room), scene.empty]
    mesh = scene.mesh
    arrays = [mesh.vertices, mesh.faces, mesh.rest, mesh.indices, mesh.weights]
    arrays += [np.array([mark.position for mark in landmarks]), np.array(scene.poses())]
    for part in scene.room.values():
        times = range(1 if part.still else scene.frames)
        arrays += [part.faces, *(part.vertices(frame / scene.fps) for frame in times)]
    whole = hashlib.sha256(json.dumps(told).encode())
    for array in arrays:
        whole.update(str(array.shape).encode())
        whole.update(np.ascontiguousarray(array).tobytes())
    return whole.hexdigest()[:32]
