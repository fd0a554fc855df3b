"""The start of each recording, found once and kept, so that all methods and workers begin alike."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from regkit.skeleton import Pose
from regkit.start import Start
from regkit.system.errors import DataError
from regkit.system.files import write_json
from regkit.tracking import Session


def start_file(folder: Path, recording: str) -> Path:
    """Where in a results folder the start of a recording is kept."""
    return folder / "starts" / f"{recording}.json"


def kept_start(session: Session, folder: Path) -> Start:
    """The given start of a session, the one kept in the results folder, or one that is found now.

    Numbers in JSON are written so that the same number is read: a start that was kept is, to the
    last bit, the one that was found.

    Raises:
        RegkitError: If none can be found, or the one that was kept is damaged.
    """
    if session.start is not None:
        return session.begin()
    file = start_file(folder, session.recording.name)
    if not file.exists():
        found = session.begin()
        kept = {
            "size": float(found.body.size),
            "root": found.pose.root.tolist(),
            "balls": found.pose.balls.tolist(),
            "hinges": found.pose.hinges.tolist(),
        }
        write_json(file, kept)
    try:
        kept = json.loads(file.read_text(encoding="utf-8"))
        body = session.template.body(kept["size"])
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
