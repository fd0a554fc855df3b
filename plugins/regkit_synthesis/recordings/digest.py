"""A name for all that a rendered recording depends on."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict

import numpy as np

from regkit_synthesis.noise import noise_of
from regkit_synthesis.recordings.scene import Scene

RENDERER = 1
"""Version of what renders; it is raised with every change that makes other images of a scene."""


def digest(scene: Scene, seed: int, noise_stream: str | None = None) -> str:
    """The first half of the SHA-256 of a scene and of its noise's seed and stream.

    It is taken of what is rendered, not of what was written to have it: the vertices, how they
    follow the bones, and where these are in each frame. So it changes with the bytes of a body's or
    a motion's file, with the map between them, and with the code that moves the one by the other.
    """
    sensor, landmarks = scene.sensor, scene.landmarks.values()
    told = [RENDERER, seed, scene.name, scene.source, scene.licence, scene.fps]
    told += [asdict(sensor.camera), sensor.depth_scale, noise_of(sensor.noise).model_dump()]
    told += [scene.joints, dict(scene.markers), [mark.bone for mark in landmarks]]
    if noise_stream is not None:
        told.append(noise_stream)
    mesh = scene.mesh
    arrays = [mesh.vertices, mesh.faces, mesh.rest, mesh.indices, mesh.weights]
    arrays += [np.array([mark.position for mark in landmarks]), np.array(scene.poses())]
    whole = hashlib.sha256(json.dumps(told).encode())
    for array in arrays:
        whole.update(str(array.shape).encode())
        whole.update(np.ascontiguousarray(array).tobytes())
    return whole.hexdigest()[:32]
