"""Unknown bodies: their shape from three frames of a depth camera or a whole scan, and tracking."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np
from _people import Person, people
from pydantic import TypeAdapter
from scipy.spatial.transform import Rotation

import regkit
from regkit.api import ShapedBody
from regkit.body import BodyDescription
from regkit.body.verdict import Verdict
from regkit.calibration import Calibration
from regkit.geometry.mesh_distance import mesh_distances
from regkit.interfaces import Method, Past, StartSearch, Template, Tracker
from regkit.system.arrays import Array
from regkit.system.errors import RegkitError
from regkit_plugins.datasets.synthetic import Synthetic, SyntheticRecording
from regkit_plugins.preprocessors.points import PointsPreprocessor
from regkit_plugins.templates.human import Human
from regkit_synthesis.bodies.bodies import BodyFile
from regkit_synthesis.motion.config import AnyMotion

SEEN = (
    ({"kind": "keyframes", "name": "wave"}, 25),
    ({"kind": "keyframes", "name": "squat"}, -20),
    ({"kind": "clip", "name": "punch"}, 15),
)
"""Motions and headings [deg] that the shape is found in."""

TRACKED = {"kind": "clip", "name": "walk", "speed": 1.3}
"""The motion that is tracked with it."""

POSES = (
    {"kind": "keyframes", "name": "arms_forward"},
    {"kind": "keyframes", "name": "bow"},
    {"kind": "keyframes", "name": "tennis"},
    {"kind": "keyframes", "name": "front_kicks"},
    {"kind": "clip", "name": "run"},
    {"kind": "clip", "name": "dance_a"},
    {"kind": "bvh", "name": "kneel"},
)
"""Motions that the scans are poses of."""

SCANS, POINTS, NOISE = 21, 20_000, 0.001
"""Number of scans, and of their points, with a standard deviation [m]."""

SEED = 4

NEAR = 0.005
"""A scan is registered if its median distance to the shaped skin is below this [m]."""


def unknown_bodies() -> dict[str, Any]:
    """Prints the tables of both, and returns their figures."""
    with tempfile.TemporaryDirectory() as folder:
        known = list(people(Path(folder)))
        return {**_from_frames(known), **_from_scans(known)}


def _from_frames(known: Sequence[Person]) -> dict[str, Any]:
    print("\nUnknown people in three frames of a Kinect (kinect_v1_320x240): mean errors of the")
    print("vertices after the best rigid motion, of the surface and the height, and of the joints")
    print("of a walk, tracked with the body that was found and with the true one")
    head = ("vertices mm", "surface mm", "height cm", "walk cm", "true body", "seconds")
    print(f"{'person':<12}" + "".join(f"{text:>13}" for text in head))
    rows = {}
    for index, person in enumerate(known):
        motion, heading = SEEN[index % len(SEEN)]
        begin = time.process_time()
        recording = _recording(person, motion, heading)
        subject = Calibration(template=Human(), frames=3).subject(recording)
        seconds = time.process_time() - begin
        assert subject.skin is not None
        placed = _placed(subject.skin.vertices, person.vertices)
        walk = _recording(person, TRACKED, 30.0, frames=45)
        rows[person.name] = row = {
            "vertices_mm": 1e3 * float(np.linalg.norm(placed - person.vertices, axis=1).mean()),
            "surface_mm": 1e3
            * float(mesh_distances(placed, person.vertices, subject.skin.faces).mean()),
            "height_cm": 100.0 * (subject.description.size.value - person.size),
            "walk_cm": _error(walk, subject.description),
            "true_body_cm": _error(walk, person.true),
            "seconds": seconds,
        }
        _print(person.name, row)
    means = {name: float(np.mean([row[name] for row in rows.values()])) for name in _NAMES}
    means["height_cm"] = float(np.mean([abs(row["height_cm"]) for row in rows.values()]))
    _print("mean", means)
    ratio = means["walk_cm"] / means["true_body_cm"]
    print(f"tracking with the body that was found: {ratio:.2f} of the error with the true one")
    return {
        "calibrated_vertex_mm": means["vertices_mm"],
        "calibrated_surface_mm": means["surface_mm"],
        "height_cm": means["height_cm"],
        "calibrated_ratio": ratio,
        "calibrated": rows,
    }


_NAMES = ("vertices_mm", "surface_mm", "height_cm", "walk_cm", "true_body_cm", "seconds")


def _from_scans(known: Sequence[Person]) -> dict[str, Any]:
    """Prints the table of whole scans, each in a pose and an orientation of its own."""
    print(f"\n{SCANS} whole scans of {POINTS} points with noise of 1 mm, turned at random: median")
    print("distances both ways, and the errors of vertices and height")
    head = ("to skin mm", "to data mm", "vertices mm", "height cm", "seconds")
    print(f"{'scan':<26}" + "".join(f"{text:>13}" for text in head))
    random, found = np.random.default_rng(SEED), []
    for index in range(SCANS):
        person, motion = known[index % len(known)], POSES[index % len(POSES)]
        points = _scanned(person, motion, 0.3 + 0.21 * index, random)
        name = f"{person.name} {motion['name']}"
        begin = time.process_time()
        try:
            one = regkit.fit_shape(points, "human")
        except RegkitError as error:
            print(f"{name:<26} not found: {error}")
            continue
        seconds = time.process_time() - begin
        found.append(_scan_row(name, one, person, seconds))
    right = sum(row["to_skin_mm"] < 1e3 * NEAR and row["vertices_mm"] < 50.0 for row in found)
    percent = 100.0 * right / SCANS
    print(f"registered: {percent:.0f} %")
    return {"scans_percent": percent, "scans": found}


def _scan_row(name: str, one: ShapedBody, person: Person, seconds: float) -> dict[str, float]:
    fit = one.fit
    placed = _placed(fit.skin().vertices, person.vertices)
    row = {
        "to_skin_mm": 1e3 * float(np.median(fit.to_skin)),
        "to_data_mm": 1e3 * float(np.median(fit.to_data)),
        "vertices_mm": 1e3 * float(np.linalg.norm(placed - person.vertices, axis=1).mean()),
        "height_cm": 100.0 * (fit.size - person.size),
        "seconds": seconds,
    }
    told = "" if one.registration.verdict is Verdict.FOUND else f"  {one.registration.verdict.name}"
    print(f"{name:<26}" + "".join(f"{cell:>13.1f}" for cell in row.values()) + told.lower())
    return row


def _print(name: str, row: dict[str, float]) -> None:
    print(f"{name:<12}" + "".join(f"{row[key]:>13.1f}" for key in _NAMES), flush=True)


def _recording(
    person: Person, motion: dict[str, Any], heading: float, frames: int = 24
) -> SyntheticRecording:
    take = {
        "body": person.config,
        "motion": motion,
        "view": {"heading_deg": heading},
        "frames": frames,
    }
    dataset = Synthetic.model_validate(
        {"kind": "synthetic", "camera": "kinect_v1_320x240", "takes": {"take": take}}
    )
    recording = dataset.only()
    assert isinstance(recording, SyntheticRecording)
    return recording


class Known(Template):
    """A template of which everything is known."""

    kind: Literal["known"] = "known"
    known: BodyDescription
    """The body at its size."""

    def description(self) -> BodyDescription:
        """Returns the description."""
        return self.known

    def given_size(self) -> float:
        """Returns the size [m]."""
        return self.known.size.value


def _error(recording: SyntheticRecording, person: BodyDescription) -> float:
    """Returns the mean error of the joints [cm] of ``best`` with a body, from the start found."""
    body = person.body("person", person.size.value)
    preprocessor = PointsPreprocessor(voxel=0.03, sigma=0.01)
    observations = [preprocessor.observation(frame) for frame in recording.frames()]
    registrar = Method.parse("best", place="benchmark", field="method").bind(body)
    tracker = Tracker.parse("constant_velocity", place="benchmark", field="t").bind(registrar)
    search = StartSearch.parse("stances", place="benchmark", field="start")
    start = search.find(Known(known=person), observations[:1])
    truth, markers = recording.truth(), body.markers
    assert truth is not None
    known = [name in truth.joints for name in markers.names]
    order = [truth.joints.index(name) for name in markers.names if name in truth.joints]
    past, errors = Past.start(start.pose), []
    for observation, places in zip(observations, truth.positions, strict=True):
        past = past.followed_by(tracker.step(observation, past))
        found = markers.place(body.place(past.last.pose).transforms)[known]
        errors.append(np.linalg.norm(found - places[order], axis=1).mean())
    return 100.0 * float(np.mean(errors))


def _placed(vertices: Array, truth: Array) -> Array:
    """Returns vertices (V, 3) after the rigid motion that brings them nearest to the truth."""
    middle, aim = vertices.mean(axis=0), truth.mean(axis=0)
    turn = Rotation.align_vectors(truth - aim, vertices - middle)[0]
    return np.asarray(turn.apply(vertices - middle) + aim)


def _scanned(
    person: Person, motion: dict[str, Any], when: float, random: np.random.Generator
) -> Array:
    """Returns points (N, 3) [m] on the surface of a person in a pose, turned at random."""
    body = BodyFile.model_validate(person.config).body()
    moved = body.moved_by(TypeAdapter(AnyMotion).validate_python(motion))
    vertices = body.mesh.posed(moved(when)) @ Rotation.random(rng=random).as_matrix().T
    corners = vertices[body.mesh.faces]
    sides = corners[:, 1:] - corners[:, :1]
    areas = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    chosen = random.choice(len(corners), POINTS, p=areas / areas.sum())
    shares = random.dirichlet(np.ones(3), POINTS)
    points = np.einsum("nc,nci->ni", shares, corners[chosen])
    return np.asarray(points + NOISE * random.standard_normal(points.shape) + [0.3, -0.2, 2.5])
