"""Frames without anybody: empty rooms, walls and boxes of a cat's size."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from _starts_bodies import Set
from _starts_options import Options
from _starts_sessions import experiment, synthetic

from regkit.experiment import Experiment
from regkit.interfaces import Start
from regkit.observation import Frame
from regkit.system.errors import DataError, RegkitError
from regkit.system.optional import one_thread
from regkit_synthesis.rooms import ROOMS

COUNT = 200
"""Number of frames, as many of each kind as of the others."""

FEWEST = 500
"""A frame shows at least this many points."""

KINDS = ("empty room", "wall", "box of a cat's size", "box on a floor")


@dataclass(frozen=True)
class Called:
    """What a search makes of a frame without anybody.

    Attributes:
        kind: What the frame shows.
        verdict: The start's verdict, or why there is none, such as that no data are left.
        bare: The same for a search in the whole frame, without segmentation.
        told: The frame in words.
    """

    kind: str
    verdict: str
    bare: str
    told: str

    def __str__(self) -> str:
        """Returns one line."""
        return f"{self.verdict}, bare {self.bare}: {self.kind}, {self.told}"


def take(chosen: Set, index: int, attempt: int) -> dict[str, Any]:
    """Returns a take without a body, in YAML's form."""
    random = np.random.default_rng([{"development": 0, "test": 1}[chosen], index, attempt])
    kind = KINDS[index % len(KINDS)]
    view = {
        "heading_deg": _uniform(random, -180.0, 180.0),
        "elevation_deg": _uniform(random, -10.0, 50.0),
        "roll_deg": float(random.choice([0.0, 0.0, 90.0, 180.0])),
    }
    return {"room": _room(kind, random), "view": view}


def _room(kind: str, random: np.random.Generator) -> Any:
    if kind == "empty room":
        # Others stand in the crowded room, and nothing in the first one.
        return str(random.choice([name for name in ROOMS if name not in ("none", "crowded")]))
    if kind == "wall":
        side = str(random.choice(["back", "back", "left", "right"]))
        height, reach = _uniform(random, 0.5, 3.0), _uniform(random, 0.2, 4.0)
        distance = _uniform(random, -0.3, 1.0)
        return {
            "wall": {
                "kind": "wall", "side": side, "distance": distance, "height": height, "reach": reach
            }
        }  # fmt: skip
    # The box is where the body would be, in the middle of the picture.
    box = {
        "kind": "box",
        "size": [_uniform(random, *span) for span in ((0.3, 0.6), (0.12, 0.25), (0.2, 0.35))],
        "distance": -0.5,
        "heading_deg": _uniform(random, -180.0, 180.0),
    }
    if kind == "box on a floor":
        return {"box": box, "floor": {"kind": "floor"}}
    return {"box": {**box, "above": _uniform(random, 0.3, 1.0)}}


def _uniform(random: np.random.Generator, low: float, high: float) -> float:
    """Returns a random number of millimetres, or of thousandths of a degree."""
    return round(float(random.uniform(low, high)), 3)


def shown(kind: str, chosen: Set, index: int) -> tuple[Experiment, Frame, str]:
    """Returns an experiment of one frame that shows something, the frame, and its take."""
    motion = {"kind": "keyframes", "name": "arms", "start": 1.0}
    for attempt in range(100):
        description = take(chosen, index, attempt)
        takes = {f"{chosen} {index} {attempt}": description}
        dataset = synthetic(takes, frames=1, empty=True, motion=motion)
        told = experiment(kind, {"kind": "human"}, dataset)
        (recording,) = told.dataset.chosen()
        # Beside the camera's view nothing can be rendered.
        with suppress(DataError):
            frame = next(recording.frames())
            if len(frame.points) >= FEWEST:
                return told, frame, str(description)
    raise AssertionError(f"no view of frame {index} shows anything")


def called(kind: str, chosen: Set, index: int) -> Called:
    """Returns what a search makes of a frame, with a template of unknown size."""
    told, frame, description = shown(kind, chosen, index)
    (recording,) = told.dataset.chosen()
    whole = told.preprocessor.preprocess(frame)
    with one_thread():
        verdict = _verdict(told.session(recording).begin)
        bare = _verdict(lambda: told.start.find(told.template, [whole]))
    return Called(KINDS[index % len(KINDS)], verdict, bare, description)


def _verdict(search: Callable[[], Start]) -> str:
    """Returns the verdict of a search, or why it gives none."""
    try:
        return str(search().verdict)
    except RegkitError as error:
        return f"refused ({error.message.partition(';')[0]})"


def figures(options: Options) -> dict[str, object]:
    """Prints what is made of frames without anybody, and returns how many are called people."""
    indices = range(min(COUNT, options.some))
    found = options.mapped("nobody", partial(called, options.start, options.chosen), indices)
    heads = ("frames", "found", "doubtful", "others", "found without segmentation")
    print(f"\n| nobody | {' | '.join(heads)} |\n|---|{'--:|' * len(heads)}")
    for kind in KINDS:
        verdicts = [one.verdict for one in found if one.kind == kind]
        counts = [len(verdicts), verdicts.count("found"), verdicts.count("doubtful")]
        bare = sum(one.bare == "found" for one in found if one.kind == kind)
        cells = [*counts, counts[0] - counts[1] - counts[2], bare]
        print(f"| {kind} | {' | '.join(map(str, cells))} |", flush=True)
    people = [one for one in found if one.verdict == "found"]
    for one in people[:10]:
        print(f"called a person: {one.kind}, {one.told}")
    return {
        "empty_rooms_called_people": len(people),
        "called_people_without_segmentation": sum(one.bare == "found" for one in found),
        "frames_without_people": len(found),
    }
