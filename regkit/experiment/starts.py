"""The start of each recording, found once and stored, so that all methods begin equally."""

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
    """Returns the file of a recording's start in a results folder."""
    return folder / "starts" / f"{recording}.json"


def kept_start(session: Session, folder: Path) -> Start:
    """Returns the session's given start, the stored one, or a newly found one.

    JSON stores floating-point numbers exactly, so a stored start equals the found one to the last
    bit.

    Raises:
        RegkitError: If no start is found, or the stored one is damaged.
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
            f"damaged ({error}); delete the file to find the start again", place=str(file)
        ) from None
    return Start(body, pose)
