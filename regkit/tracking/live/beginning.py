"""The beginning of a live track: the first opening in which a body is found."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from regkit.body.verdict import Verdict
from regkit.interfaces import Recording, Start
from regkit.system.brief import Brief
from regkit.system.errors import NoBodyError, NoDataError
from regkit.system.notes import RegkitWarning
from regkit.system.progress import working
from regkit.tracking.live.opening import Opening
from regkit.tracking.session import Session


@dataclass(frozen=True)
class Beginning(Brief):
    """What a live track begins with.

    Attributes:
        session: The session of the opening.
        start: The body, and its pose in the opening's first frame with data.
        opening: The opening.
    """

    session: Session
    start: Start
    opening: Opening


def beginning_in(
    openings: Iterable[Opening], session_of: Callable[[Recording], Session], *, live: bool
) -> Beginning:
    """Returns the first opening in which a body is found, with its session and start.

    Args:
        openings: The openings of a stream, read as they are asked for.
        session_of: Returns the session of an opening.
        live: Whether the stream is a camera's. A recording without a surely found body is tracked
            from its first frames, and said to be lost.

    Raises:
        NoBodyError: If no body is found; the last reason is told.
        RegkitError: If a session cannot begin.
    """
    first: Beginning | None = None
    reason = NoDataError("it has no frame with a measurement")
    for opening in openings:
        session = session_of(opening.recording)
        # What is told of an attempt matters only if the tracking begins with it.
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            try:
                with working("looking for the body"):
                    start = session.begin()
            except NoDataError as error:
                reason = error
                continue
        missed = start.verdict is Verdict.LOST
        for one in told:
            if not missed or not issubclass(one.category, RegkitWarning):
                warnings.warn_explicit(one.message, one.category, one.filename, one.lineno)
        found = Beginning(session, start, opening)
        if not missed:
            return found
        first = first or found
    if first is not None and not live:
        return first
    raise NoBodyError(f"no body comes into sight: {reason.message}")
