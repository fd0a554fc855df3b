"""Two hands as one composed body, beside each of them alone; and real hands with a forearm."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from _bodies_objects import hand_with_can
from _bodies_recovery import after_jumps, jumping
from _bodies_starts import starts
from _starts_sr305 import DATA, SEQUENCES, tracked_hand

from regkit.body import Body
from regkit.config.document import Document
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import from_matrix, to_vector
from regkit.interfaces import Method, Past, StartSearch, Template, Tracker
from regkit.metrics import exchanged_frames
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit_plugins.datasets.synthetic import Synthetic, SyntheticRecording
from regkit_plugins.preprocessors.points import PointsPreprocessor
from regkit_plugins.presets import TWO_HANDS

LENGTH = 0.1858
"""Length of the average hand [m]."""

SIDES = ("right", "left")

POINTS = PointsPreprocessor(voxel=0.008, sigma=0.004)

LOST = 0.02
"""A hand with a larger mean joint error is lost [m]."""

FIT_STEPS, FIT_DAMPING = 60, 1e-6
"""Gauss-Newton steps that pose a body by the markers of the first frame, and their damping."""


def two_hands() -> dict[str, object]:
    """Prints the tables of two hands, and returns figures.

    The hands are tracked from the pose whose markers are nearest to the truth in the first frame,
    so that only tracking is measured, and from the start that is found there. Beside each take
    stand the same hands, each tracked alone in a recording without the other, from the former.
    """
    print(f"\n{'two hands':<14}{'both mm':>16}{'alone mm':>16}{'ratio':>8}{'exchanged':>11}"
          f"{'from found start':>18}{'ratio':>8}{'exchanged':>11}")  # fmt: skip
    figures: dict[str, object] = {}
    errors: dict[str, list[Array]] = {"given": [], "found": [], "alone": []}
    exchanged = 0
    both = _template({"kind": "composed", "free": {side: _hand(side) for side in SIDES}})
    recordings = [one for one in _dataset().chosen() if isinstance(one, SyntheticRecording)]
    for recording in recordings:
        alone = np.concatenate([_alone(recording, side) for side in SIDES], axis=1)
        errors["alone"].append(alone)
        row: dict[str, float] = {"alone_mm": round(1e3 * float(alone.mean()), 2)}
        cells = []
        for start in ("given", "found"):
            truth, places, names = _tracked(both, recording, found=start == "found")
            own = np.linalg.norm(places - truth, axis=2)
            errors[start].append(own)
            switched = exchanged_frames(names, [one.split("_")[0] for one in names], places, truth)
            assert switched is not None
            exchanged += int(switched.sum())
            row |= {
                f"{start}_mm": round(1e3 * float(own.mean()), 2),
                f"{start}_ratio": round(float(own.mean() / alone.mean()), 3),
                f"{start}_exchanged_frames": int(switched.sum()),
            }
            halves = [1e3 * one.mean() for one in np.split(own, 2, 1)]
            cells.append(f"{halves[0]:.1f} / {halves[1]:.1f}")
        halves = [1e3 * one.mean() for one in np.split(alone, 2, 1)]
        cells.insert(1, f"{halves[0]:.1f} / {halves[1]:.1f}")
        print(
            f"{recording.name:<14}{cells[0]:>16}{cells[1]:>16}{row['given_ratio']:>8.2f}"
            f"{row['given_exchanged_frames']:>11}{cells[2]:>18}{row['found_ratio']:>8.2f}"
            f"{row['found_exchanged_frames']:>11}",
            flush=True,
        )
        figures[recording.name] = row
    means = {name: float(np.concatenate(each).mean()) for name, each in errors.items()}
    return {
        "takes": figures,
        "ratio": round(means["given"] / means["alone"], 3),
        "found_ratio": round(means["found"] / means["alone"], 3),
        "identities_kept": exchanged == 0,
        "starts": starts(recordings, both, POINTS),
    }


def jumps() -> dict[str, object]:
    """Prints what the search of a lost hand beside the other gains, and returns figures.

    In each of six recordings one hand jumps twice by some 20 cm and turns by about 100 degrees.
    """
    both = _template({"kind": "composed", "free": {side: _hand(side) for side in SIDES}})
    found: dict[str, list[Array]] = {"sought": [], "not": []}
    for recording in jumping():
        for name, recovery in (("sought", {}), ("not", {"reinitialization": None})):
            truth, places, names = _tracked(both, recording, recovery=recovery)
            side = recording.name.split("_")[0]
            own = np.array([one.startswith(side) for one in names])
            errors = np.linalg.norm(places - truth, axis=2)[:, own].mean(axis=1)
            found[name].append(after_jumps(errors, recording.fps))
    told: dict[str, object] = {}
    for name, each in found.items():
        errors = np.concatenate(each)
        percent = 100.0 * float((errors < LOST).mean())
        words = "with the search" if name == "sought" else "without"
        print(f"hand that jumps, {words}: {1e3 * errors.mean():.1f} mm, "
              f"{percent:.0f} % of the frames within {1e3 * LOST:.0f} mm", flush=True)  # fmt: skip
        told[name] = {"mm": round(1e3 * float(errors.mean()), 2), "percent": round(percent, 1)}
    return told


def carried() -> dict[str, float]:
    """Prints the starts of a hand with a can, and returns figures."""
    return hand_with_can(LENGTH, POINTS)


def forearm_sr305() -> dict[str, float]:
    """Returns the median distance of real data to a hand with a forearm, by sequence [mm]."""
    if not DATA.is_dir():
        return {}
    found = {}
    for sequence in SEQUENCES:
        hands = tracked_hand(sequence, _template({"kind": "hand", "forearm": True}))
        found[sequence] = round(1e3 * float(np.median([hand.distance for hand in hands])), 2)
        print(f"SR305 {sequence}, hand with forearm: {found[sequence]:.1f} mm to the surface")
    return found


def _dataset() -> Synthetic:
    return Document.read(TWO_HANDS).validated(Synthetic)


def _hand(side: str) -> dict[str, Any]:
    return {"kind": "hand", "side": side, "length": LENGTH}


def _template(data: Mapping[str, Any]) -> Template:
    return Template.parse(dict(data), place="benchmark", field="template")


def _alone(recording: SyntheticRecording, side: str) -> Array:
    """Returns the errors (T, 21) [m] of one hand tracked alone, in the same motion."""
    take = recording.take
    assert take.bodies is not None
    part = take.bodies[side].model_dump(exclude_unset=True)
    name = f"{recording.name}_{side}"
    whole = recording.dataset.model_dump(exclude_unset=True, exclude={"takes", "defaults"})
    alone = {"frames": take.frames, "view": take.view.model_dump(exclude_unset=True), **part}
    (only,) = Synthetic.model_validate({**whole, "takes": {name: alone}}).chosen()
    assert isinstance(only, SyntheticRecording)
    truth, places, _ = _tracked(_template(_hand(side)), only)
    return np.asarray(np.linalg.norm(places - truth, axis=2))


def _tracked(
    template: Template,
    recording: SyntheticRecording,
    *,
    found: bool = False,
    recovery: Mapping[str, Any] | None = None,
) -> tuple[Array, Array, tuple[str, ...]]:
    """Returns the true and the tracked positions (T, J, 3) [m] of the joints, and their names.

    Args:
        template: The template.
        recording: The recording.
        found: Whether the start is searched; otherwise it is nearest to the truth.
        recovery: Fields of the tracker's recovery; by default none.
    """
    body = template.body(LENGTH)
    registrar = Method.parse("best", place="benchmark", field="method").bind(body)
    follows = {"kind": "constant_velocity", "recovery": dict(recovery or {})}
    tracker = Tracker.parse(follows, place="benchmark", field="tracker").bind(registrar)
    truth = recording.truth()
    assert truth is not None
    order = np.array([body.markers.names.index(joint) for joint in truth.joints])
    if found:
        search = StartSearch.parse(StartSearch.default(), place="benchmark", field="start")
        first = POINTS.preprocess(next(iter(recording.frames())))
        past = Past.start(search.find(template, [first]).pose)
    else:
        past = Past.start(_posed(body, order, truth.positions[0]))
    places = []
    for frame in recording.frames():
        past = past.followed_by(tracker.step(POINTS.preprocess(frame), past))
        transforms = body.place(past.last.pose).transforms
        places.append(body.markers.place(transforms)[order])
    return truth.positions, np.array(places), truth.joints


def _posed(body: Body, order: Array, places: Array) -> Pose:
    """Returns the pose within the limits whose markers are nearest to places (J, 3) [m]."""
    bones, pose = body.skeleton, body.skeleton.rest()
    names = [body.markers.segments[index] for index in order]
    free = [bones.free_dofs[first : first + 6] for first in range(0, len(bones.free_dofs), 6)]
    groups = [np.isin(names, part.segments) for part in body.parts] or [np.ones(len(order), bool)]
    for dofs, own in zip(free, groups, strict=True):
        rest = body.markers.place(body.place(pose).transforms)[order[own]]
        goal = places[own]
        u, _, vt = np.linalg.svd((rest - rest.mean(axis=0)).T @ (goal - goal.mean(axis=0)))
        turn = vt.T @ np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt))]) @ u.T
        # Every free segment is at the origin at rest, so that its step is its transform.
        step = np.zeros(bones.dofs)
        moved = rigid(turn, goal.mean(axis=0) - turn @ rest.mean(axis=0))
        step[dofs] = [*moved[:3, 3], *to_vector(from_matrix(turn))]
        pose = bones.retract(pose, step)
    for _ in range(FIT_STEPS):
        placement = body.place(pose)
        gaps = (body.markers.place(placement.transforms)[order] - places).ravel()
        jacobian = body.markers.jacobian(placement)[order].reshape(len(gaps), -1)
        normal = jacobian.T @ jacobian + FIT_DAMPING * np.eye(bones.dofs)
        pose = bones.limits.projected(
            bones.retract(pose, -np.linalg.solve(normal, jacobian.T @ gaps))
        )
    return pose
