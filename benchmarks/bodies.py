"""Errors of robots, of people with hands, of two hands, and of unknown bodies.

    python benchmarks/bodies.py [ROBOT.urdf]

The robot, by default the arm of the examples, is imported from its URDF file. It moves between
random poses within two fifths of its joints' limits, seen from random sides by a depth camera of
320 x 240 pixels with noise of 2 mm. The first frame starts beside the truth, each joint by 1.7
degrees or 30 mm (standard deviation); each other frame starts at the last pose. Each track by
`robots` is then solved again with one base for all its frames, as by ``regkit calibrate --base``.
The squared error of this base in its own standard deviations is 1 on average where they are right.
One thread.

People with hands gesture a metre before an upright camera with noise of 3 mm, as tracked from the
start that is found (`_bodies_hands.py`); beside them is the error of the body alone.

Two hands of the preset `two_hands` are tracked as one composed body, from the true pose and from
the start that is found, and each of them alone in the same motion; real hands are tracked with a
forearm (`_bodies_several.py`). One in five of their frames is a first frame for a start from
nothing (`_bodies_starts.py`), and in others one hand jumps, so that it has to be found again
(`_bodies_recovery.py`). A hand with a can that it carries is found from nothing
(`_bodies_objects.py`).

The shape of unknown people is found in three frames and in whole scans (`_bodies_shape.py`); what
was chosen was chosen on other people.
"""

from __future__ import annotations

import json
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from _bodies_hands import hands_with_body
from _bodies_several import carried, forearm_sr305, jumps, two_hands
from _bodies_shape import unknown_bodies
from threadpoolctl import threadpool_limits

from regkit.body import Body
from regkit.calibration.base import FixedBase
from regkit.calibration.base.solution import middle, solved
from regkit.geometry.camera import Camera
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.interchange.skeletons import read_skeleton
from regkit.interfaces import Method, Registrar, Solver
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
    """Print the tables and the JSON object."""
    body = imported(robot)
    registrars = {
        name: Method.parse(name, place="benchmark", field="method").bind(body) for name in METHODS
    }
    found = {name: tracks(registrar) for name, registrar in registrars.items()}
    print(f"{body.name}: {TRACKS} tracks of {FRAMES} frames, means (medians)")
    print(f"{'method':<16}{'base mm':>16}{'base deg':>16}{'hinges deg':>16}{'slides mm':>16}")
    figures = {name: told(name, body, errors_of(body, several)) for name, several in found.items()}
    base = [one_base(registrars["robots"], one) for one in found["robots"]]
    errors = np.concatenate([one.errors for one in base])
    figures["one base"] = told("one base", body, errors)
    squares = float(np.mean([one.squares for one in base]))
    middles = np.array([one.of_middle for one in base])
    print(f"median of the bases: {middles[:, 0].mean():.2f} mm, {middles[:, 1].mean():.2f} deg")
    print(f"squared error of the one base in standard deviations: {squares:.2f}")
    arm = {"arm_deg": figures["robots"]["hinges_deg"], "methods": figures}
    hands = {"two_hands": two_hands(), "hand_that_jumps": jumps(), "hand_with_can": carried()}
    several = {**hands, "forearm_sr305_mm": forearm_sr305()}
    print(json.dumps({**unknown_bodies(), **arm, **hands_with_body(), **several}))


def told(name: str, body: Body, errors: Array) -> dict[str, float]:
    """Prints a method's row; returns the means."""
    slides = body.skeleton.limits.prismatic
    parts = {
        "base_mm": errors[:, :1],
        "base_deg": errors[:, 1:2],
        "hinges_deg": errors[:, 2:][:, ~slides],
        "slides_mm": errors[:, 2:][:, slides],
    }
    cells = [f"{part.mean():.2f} ({np.median(part):.2f})" for part in parts.values()]
    print(f"{name:<16}" + "".join(f"{cell:>16}" for cell in cells))
    return {key: float(part.mean()) for key, part in parts.items() if part.size}


@dataclass(frozen=True)
class Tracked:
    """A track: what is seen, the true poses and those found, frame by frame."""

    seen: list[Observation]
    truth: list[Pose]
    found: list[Pose]


@dataclass(frozen=True)
class OneBase:
    """A track with one base: its errors, the base's squared error, and that of the middle base."""

    errors: Array
    squares: float
    of_middle: tuple[float, float]


def one_base(registrar: Registrar, track: Tracked) -> OneBase:
    """Returns a track solved again with one base for all frames."""
    bones = registrar.body.skeleton
    settings = FixedBase.model_fields["solver"].get_default(call_default_factory=True)
    solver = Solver.parse(settings, place="benchmark", field="solver")
    base = solved(registrar, track.seen, track.found, solver)
    again = Tracked(track.seen, track.truth, list(base.poses))
    truth = track.truth[0]
    off = bones.difference(truth, Pose(base.T_world_base, truth.balls, truth.hinges))[:6]
    alone = middle(np.array([pose.root for pose in track.found]))
    beside = bones.difference(truth, Pose(alone, truth.balls, truth.hinges))[:6]
    return OneBase(
        errors_of(registrar.body, [again]),
        float(off @ np.linalg.solve(base.covariance, off)) / len(off),
        (1e3 * float(np.linalg.norm(beside[:3])), float(np.degrees(np.linalg.norm(beside[3:])))),
    )


def errors_of(body: Body, several: Sequence[Tracked]) -> Array:
    """Returns the errors of all frames: base [mm], [deg], and hinges [deg] or [mm]."""
    bones = body.skeleton
    units = np.where(bones.limits.prismatic, 1e3, 180.0 / np.pi)
    rows = []
    for track in several:
        for truth, pose in zip(track.truth, track.found, strict=True):
            off = bones.difference(truth, pose)
            place, turn = np.linalg.norm(off[:3]), np.linalg.norm(off[3:6])
            rows.append([1e3 * place, np.degrees(turn), *(units * np.abs(off[bones.hinge_dofs]))])
    return np.array(rows)


def imported(robot: Path) -> Body:
    """Returns a robot's body with its skin."""
    found = read_skeleton(robot)
    with tempfile.TemporaryDirectory() as folder:
        mesh = Path(folder) / "mesh.npz"
        if found.skin is not None:
            found.skin.write(mesh)
        description = found.description.model_copy(update={"mesh": mesh})
        return description.body(robot.stem, description.size.value)


def tracks(registrar: Registrar) -> list[Tracked]:
    """Returns the tracks of a method."""
    body, random = registrar.body, np.random.default_rng(0)
    bones, caster = body.skeleton, RayCaster(CAMERA)
    found = []
    for _ in range(TRACKS):
        root = seen_from(random)
        balls, ends = bones.limits.sampled(random, 2)
        last = None
        track = Tracked([], [], [])
        for share in 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, FRAMES)):
            hinges = PART * ((1.0 - share) * ends[0] + share * ends[1])
            truth = bones.limits.hinged(Pose(root, balls[0], hinges))
            observation = observed(body, caster, truth, random)
            if last is None:
                last = bones.limits.projected(
                    bones.retract(truth, BESIDE * random.standard_normal(bones.dofs))
                )
            last = registrar.register(observation, [last]).pose
            track.seen.append(observation)
            track.truth.append(truth)
            track.found.append(last)
        found.append(track)
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
