"""The start of each recording, found once and kept, so that all methods and workers begin alike."""

from __future__ import annotations

import json
from collections.abc import Iterator
from itertools import islice
from pathlib import Path

import numpy as np

from regkit.experiment.experiment import Experiment
from regkit.interfaces import Recording
from regkit.observation import Observation
from regkit.skeleton import Pose
from regkit.start import Start, found_start, given_start
from regkit.system.errors import DataError, RegkitError
from regkit.system.files import write_json


def start_file(folder: Path, recording: str) -> Path:
    """Where in a results folder the start of a recording is kept."""
    return folder / "starts" / f"{recording}.json"


def start_of(experiment: Experiment, recording: Recording, folder: Path) -> Start:
    """The given start of a recording, the one kept in the results folder, or one that is found now.

    Numbers in JSON are written so that the same number is read: a start that was kept is, to the
    last bit, the one that was found.

    Raises:
        RegkitError: If none can be found, or the one that was kept is damaged.
    """
    template = experiment.template_of(recording)
    if experiment.start is not None:
        return given_start(template, experiment.start)
    file = start_file(folder, recording.name)
    if not file.exists():
        found = found_start(template, *_looked_at(experiment, recording))
        pose = found.pose
        kept = {
            "size": float(found.body.size),
            "root": pose.root.tolist(),
            "balls": pose.balls.tolist(),
            "hinges": pose.hinges.tolist(),
        }
        write_json(file, kept)
    try:
        kept = json.loads(file.read_text(encoding="utf-8"))
        body = template.body(kept["size"])
        rest = body.skeleton.rest()
        pose = Pose(
            np.array(kept["root"], dtype=float).reshape(rest.root.shape),
            np.array(kept["balls"], dtype=float).reshape(rest.balls.shape),
            np.array(kept["hinges"], dtype=float).reshape(rest.hinges.shape),
        )
    except (ValueError, TypeError, KeyError) as error:
        raise DataError(
            f"damaged ({error}); delete the file to have the start found again", place=str(file)
        ) from None
    return Start(body, pose)


def _looked_at(experiment: Experiment, recording: Recording) -> Iterator[Observation]:
    """The first frame, and two later ones where the size is unknown and they can be used."""
    sized = experiment.template_of(recording).given_size() is not None
    last = recording.length - 1
    wanted = {0} if sized else {0, last // 2, last}
    for index, frame in enumerate(islice(recording.frames(), 1 + max(wanted))):
        if index not in wanted:
            continue
        try:
            yield experiment.preprocessor.preprocess(frame)
        except RegkitError as error:
            # What is wrong with a later frame is told when it is tracked.
            if index == 0:
                raise error.at(frame.place or recording.name) from None
