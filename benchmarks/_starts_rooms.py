"""People in rooms, tracked as a user tracks them, against the same motion alone."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from _starts_bodies import Set
from _starts_options import Options
from _starts_sessions import experiment, synthetic
from numpy.typing import NDArray

from regkit.body import Body
from regkit.interfaces.segmenter import each_body
from regkit.metrics.matching import matched
from regkit.observation import Frame, Truth
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.errors import RegkitError
from regkit.system.optional import one_thread
from regkit.tracking import Session
from regkit_synthesis.rooms import ROOMS

FRAMES = 60
"""Two seconds."""

TAKES: Mapping[Set, tuple[Mapping[str, Any], ...]] = {
    "development": (
        {
            "body": "average",
            "motion": {"kind": "clip", "name": "walk", "way": 0.2},
            "view": {"heading_deg": 20},
        },
        {
            "body": "small",
            "motion": {"kind": "keyframes", "name": "arms"},
            "view": {"heading_deg": 150, "elevation_deg": 15},
        },
    ),
    "test": (
        {
            "body": "tall",
            "motion": {"kind": "bvh", "name": "walk_and_turn", "way": 0.3},
            "view": {"heading_deg": -25, "elevation_deg": 10},
        },
        {
            "body": "tall",
            "motion": {"kind": "keyframes", "name": "tennis"},
            "view": {"heading_deg": 60},
        },
    ),
}
"""Two takes of each set, from the front and from aside or behind."""

ASKED_FOR = "crowded, asked for"
"""The person who is asked for, among those that `regkit track --people all` finds."""

ROWS: Mapping[str, str] = {**dict(zip(ROOMS, ROOMS, strict=True)), ASKED_FOR: "crowded"}
"""Room of each row."""

HIDES = 0.25
"""What is nearer than a joint by more than this hides it; a trunk is half as thick [m]."""

HEIGHTS = {"average": 1.6327, "small": 1.4901, "tall": 1.88}


@dataclass(frozen=True)
class InRoom:
    """A take in a room.

    Attributes:
        room: Name of the row.
        error: Mean error of all joints in all frames [m]; infinite if nothing was tracked.
        shown: The same of the joints that nothing hides.
        first: The same in the first frame [m].
        verdict: The start's verdict, or why there is none.
    """

    room: str
    error: float
    shown: float
    first: float
    verdict: str


def tracked(kind: str, item: tuple[str, Mapping[str, Any]]) -> InRoom:
    """Returns the errors of a take in a row's room, given by name."""
    row, take = item
    template = {"kind": "human", "build": take["body"], "height": HEIGHTS[take["body"]]}
    chosen = experiment(kind, template, synthetic({"take": take}, frames=FRAMES, room=ROWS[row]))
    (recording,) = chosen.dataset.chosen()
    session, method, truth = chosen.session(recording), chosen.methods["best"], recording.truth()
    assert truth is not None
    try:
        with one_thread():
            if row == ASKED_FOR:
                session = _asked_for(session, truth)
            start = session.begin()
            body, tracker = start.body, method.tracker or chosen.tracker
            frames = list(session.tracked(method.bind(body), tracker, start.pose))
    except RegkitError as error:
        return InRoom(row, np.inf, np.inf, np.inf, str(error))
    errors = np.array([
        _errors(body, frame.registered.pose, truth, index) for index, frame in enumerate(frames)
    ])  # fmt: skip
    shown = np.array([_shown(body, truth, at, one) for at, one in enumerate(recording.frames())])
    means = (errors.mean(), errors[shown].mean(), errors[0].mean())
    return InRoom(row, *map(float, means), str(start.verdict))


def _asked_for(session: Session, truth: Truth) -> Session:
    """Returns the session of the person, of all that are found, who is nearest to the truth."""

    def away(one: Session) -> float:
        start = one.begin()
        return float(_errors(start.body, start.pose, truth, 0).mean())

    each = each_body(session.segmentation, session.recording, session.template)
    return min((replace(session, segmentation=one) for one in each), key=away)


def _errors(body: Body, pose: Pose, truth: Truth, frame: int) -> Array:
    """Returns the distances (J,) [m] of a body's markers to the true joints of a frame."""
    columns, markers = matched(body, truth, {})
    placed = body.markers.place(body.place(pose).transforms)[markers]
    return np.asarray(np.linalg.norm(placed - truth.positions[frame, columns], axis=1))


def _shown(body: Body, truth: Truth, index: int, frame: Frame) -> NDArray[np.bool_]:
    """Returns which joints (J,) of a frame are in the picture, and hidden by nothing."""
    columns, _ = matched(body, truth, {})
    places, camera, depth = truth.positions[index, columns], frame.camera, frame.depth
    assert camera is not None
    assert depth is not None
    across, down = np.rint(camera.projected(places)).astype(int).T
    inside = (across >= 0) & (across < camera.width) & (down >= 0) & (down < camera.height)
    seen = np.zeros(len(places))
    seen[inside] = depth[down[inside], across[inside]]
    return np.asarray(inside & ~((seen > 0.0) & (seen < places[:, 2] - HIDES)))


def figures(options: Options) -> dict[str, object]:
    """Prints the table of rooms, and returns their figures."""
    takes = TAKES[options.chosen]
    items = [(room, take) for room in ROWS for take in takes]
    found = options.mapped("rooms", partial(tracked, options.start), items)
    alone = [one.error for one in found if one.room == "none"]
    heads = [f"{take['body']}, {take['motion']['name']}" for take in takes]
    columns = " | ".join(f"{head} [cm] | first frame | start" for head in heads)
    print(f"\n| room | {columns} | ratio | of what is in sight |")
    print("|---|" + "--:|--:|---|" * len(heads) + "--:|--:|")
    ratios, in_sight = {}, {}
    alone_shown = sum(one.shown for one in found if one.room == "none")
    for room in ROWS:
        rows = [one for one in found if one.room == room]
        ratios[room] = sum(one.error for one in rows) / sum(alone)
        in_sight[room] = sum(one.shown for one in rows) / alone_shown
        cells = [f"{100 * one.error:.1f} | {100 * one.first:.1f} | {one.verdict}" for one in rows]
        told = f"{ratios[room]:.2f} | {in_sight[room]:.2f}"
        print(f"| {room} | {' | '.join(cells)} | {told} |", flush=True)
    others = [ratios[room] for room in ROOMS if room != "none"]
    if not np.isfinite(others).all():
        return {"rooms": {"untracked": sum(not np.isfinite(one.error) for one in found)}}
    return {
        "rooms_ratio": round(float(np.mean(others)), 2),
        "rooms_worst_ratio": round(max(others), 2),
        "asked_for_ratio": round(ratios[ASKED_FOR], 2),
        "desk_in_sight_ratio": round(in_sight["desk"], 2),
    }
