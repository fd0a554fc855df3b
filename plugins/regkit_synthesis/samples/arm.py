"""A six-joint arm on a rail before a depth camera: the sample of robots.

python -m regkit_synthesis.samples.arm docs/examples/robots/arm.urdf docs/examples/data/arm
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Final

import numpy as np

from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.geometry.surface import SkinnedSurface
from regkit.interchange.skeletons import read_skeleton
from regkit.sensors.raycast import RayCaster
from regkit.sensors.sensor import Sensor
from regkit.skeleton import Placement, Pose, Skeleton
from regkit.skeleton.compile import compiled
from regkit.system.csv_table import csv_text
from regkit.system.errors import DataError
from regkit.system.files import write_text
from regkit_synthesis.recordings.recording import DepthRecording

FRAMES, FPS = 16, 10.0

CAMERA: Final = "kinect_v1_320x240"

MOTION = {
    "carriage": (0.12, 0.10, 0.0),
    "shoulder": (0.1, 0.5, 0.8),
    "upper_arm": (0.3, 0.3, 1.6),
    "elbow": (0.3, 0.4, 2.4),
    "forearm": (0.3, 0.4, 0.4),
    "wrist": (0.3, 0.5, 1.2),
    "palm": (0.2, 0.6, 2.0),
    "left_finger": (0.025, 0.02, 2.8),
}
"""Mean, amplitude and phase of each joint's oscillation [rad or m], by link."""


def main(robot: Path, folder: Path) -> None:
    """Write the recording of a robot, and its true joints, to a folder."""
    imported = read_skeleton(robot)
    if imported.skin is None:
        raise DataError("the robot has no shapes that a camera would see", place=str(robot))
    bones, surface = compiled(imported.description), SkinnedSurface.of(imported.skin)
    sensor, random = Sensor.of(CAMERA), np.random.default_rng(0)
    caster = RayCaster(sensor.camera)
    images, truth, joints = [], [], []
    for frame in range(FRAMES):
        pose = posed(bones, frame)
        transforms = Placement.of(bones, pose).transforms
        view = caster.view(surface.place(transforms), surface.faces)
        images.append(sensor.image(view, random))
        truth.append(transforms[:, :3, 3])
        joints.append([frame, *(f"{value:.6f}" for value in pose.hinges)])
    recording = DepthRecording(
        name="arm",
        fps=FPS,
        depth_scale=sensor.depth_scale,
        source=f"Rendered by regkit_synthesis: {robot.name}",
        licence="CC0-1.0",
        camera=sensor.camera,
        depth=np.array(images),
        joints=bones.names,
        truth=np.array(truth),
    )
    recording.write(folder)
    write_text(folder / "hinges.csv", csv_text(("frame", *bones.hinge_columns), joints))


def posed(bones: Skeleton, frame: int) -> Pose:
    """Returns the pose in a frame: the base stands still, and every joint oscillates."""
    phase = 2.0 * np.pi * frame / FPS / 3.0
    moves = [MOTION.get(name, (0.0, 0.0, 0.0)) for name in bones.hinge_names]
    hinges = np.array([mean + size * np.sin(phase + at) for mean, size, at in moves])
    # The camera looks down at the base by 20 degrees, from 35 degrees to its side.
    down = vector_to_matrix(np.array([0.35, 0.0, 0.0]))
    turned = vector_to_matrix(np.array([0.0, np.radians(35.0), 0.0]))
    root = rigid(down @ np.diag([1.0, -1.0, -1.0]) @ turned, np.array([-0.05, 0.3, 1.5]))
    return bones.limits.projected(Pose(root, np.zeros((0, 4)), hinges))


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
