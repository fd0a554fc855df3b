"""Errors of a robot's joints, of its base and its slides, by method; and of people with hands.

    python benchmarks/bodies.py [ROBOT.urdf]

The robot, by default the arm of the examples, is imported from its URDF file. It moves between
random poses within two fifths of its joints' limits, seen from random sides by a depth camera of
320 x 240 pixels with noise of 2 mm. The first frame starts beside the truth, each joint by 1.7
degrees or 30 mm (standard deviation); each other frame starts at the last pose. One thread.

People with hands gesture a metre before an upright camera with noise of 3 mm, as tracked from the
start that is found (`_bodies_hands.py`); beside them is the error of the body alone.

Two hands of the preset `two_hands` are tracked as one composed body, and each of them alone in the
same motion; real hands are tracked with a forearm (`_bodies_several.py`).
"""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path

import numpy as np
from _bodies_hands import hands_with_body
from _bodies_several import forearm_sr305, two_hands
from threadpoolctl import threadpool_limits

from regkit.body import Body
from regkit.geometry.camera import Camera
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.interchange.skeletons import read_skeleton
from regkit.interfaces import Method, Registrar
from regkit.observation import Frame, Observation
from regkit.sensors.raycast import RayCaster
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit_plugins.preprocessors.points import PointsPreprocessor

ARM = Path(__file__).parents[1] / "docs" / "examples" / "robots" / "arm.urdf"
METHODS = ("robots", "icp", "spheres", "best")
TRACKS, FRAMES, PART = 8, 20, 0.4
NOISE, BESIDE = 0.002, 0.03
CAMERA = Camera(width=320, height=240, fx=300.0, fy=300.0, cx=159.5, cy=119.5)


def main(robot: Path) -> None:
    """Print the table and the JSON object."""
    body = imported(robot)
    registrars = {
        name: Method.parse(name, place="benchmark", field="method").bind(body) for name in METHODS
    }
    errors = {name: np.concatenate([*tracks(registrar)]) for name, registrar in registrars.items()}
    slides = body.skeleton.limits.prismatic
    print(f"{body.name}: {TRACKS} tracks of {FRAMES} frames, means (medians)")
    print(f"{'method':<10}{'base mm':>16}{'base deg':>16}{'hinges deg':>16}{'slides mm':>16}")
    figures = {}
    for name, found in errors.items():
        parts = {
            "base_mm": found[:, :1],
            "base_deg": found[:, 1:2],
            "hinges_deg": found[:, 2:][:, ~slides],
            "slides_mm": found[:, 2:][:, slides],
        }
        figures[name] = {key: float(part.mean()) for key, part in parts.items() if part.size}
        cells = [f"{part.mean():.2f} ({np.median(part):.2f})" for part in parts.values()]
        print(f"{name:<10}" + "".join(f"{cell:>16}" for cell in cells))
    arm = {"arm_deg": figures["robots"]["hinges_deg"], "methods": figures}
    several = {"two_hands": two_hands(), "forearm_sr305_mm": forearm_sr305()}
    print(json.dumps({**arm, **hands_with_body(), **several}))


def imported(robot: Path) -> Body:
    """Returns a robot's body with its skin."""
    found = read_skeleton(robot)
    with tempfile.TemporaryDirectory() as folder:
        mesh = Path(folder) / "mesh.npz"
        if found.skin is not None:
            found.skin.write(mesh)
        description = found.description.model_copy(update={"mesh": mesh})
        return description.body(robot.stem, description.size.value)


def tracks(registrar: Registrar) -> list[Array]:
    """Returns the errors of each track: base [mm], [deg], and hinges [deg] or [mm]."""
    body, random = registrar.body, np.random.default_rng(0)
    bones, caster = body.skeleton, RayCaster(CAMERA)
    units = np.where(bones.limits.prismatic, 1e3, 180.0 / np.pi)
    found = []
    for _ in range(TRACKS):
        root = seen_from(random)
        balls, ends = bones.limits.sampled(random, 2)
        last = None
        rows = []
        for share in 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, FRAMES)):
            hinges = PART * ((1.0 - share) * ends[0] + share * ends[1])
            truth = bones.limits.hinged(Pose(root, balls[0], hinges))
            observation = observed(body, caster, truth, random)
            if last is None:
                last = bones.limits.projected(
                    bones.retract(truth, BESIDE * random.standard_normal(bones.dofs))
                )
            last = registrar.register(observation, [last]).pose
            off = bones.difference(truth, last)
            rows.append(
                [
                    1e3 * np.linalg.norm(off[:3]),
                    np.degrees(np.linalg.norm(off[3:6])),
                    *(units * np.abs(off[bones.hinge_dofs])),
                ]
            )
        found.append(np.array(rows))
    return found


def seen_from(random: np.random.Generator) -> Array:
    """Returns T_camera_base of a camera 2 m away, on any side, 5 to 35 degrees above."""
    down = vector_to_matrix(np.array([random.uniform(0.1, 0.6), 0.0, 0.0]))
    turn = vector_to_matrix(np.array([0.0, random.uniform(-np.pi, np.pi), 0.0]))
    return rigid(down @ np.diag([1.0, -1.0, -1.0]) @ turn, np.array([0.0, 0.25, 2.0]))


def observed(body: Body, caster: RayCaster, pose: Pose, random: np.random.Generator) -> Observation:
    """Returns what the camera sees of a body with a surface in a pose."""
    assert body.surface is not None
    vertices = body.surface.place(body.place(pose).transforms)
    depth = caster.view(vertices, body.surface.faces).depth
    hit = depth > 0.0
    depth = np.where(hit, depth + NOISE * random.standard_normal(depth.shape), 0.0)
    frame = Frame(CAMERA.back_projected(depth), CAMERA, depth)
    return PointsPreprocessor(voxel=0.012, sigma=0.005).preprocess(frame)


if __name__ == "__main__":
    with threadpool_limits(1):
        main(Path(sys.argv[1]) if len(sys.argv) > 1 else ARM)
