"""The order of the tasks."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable

from regkit.experiment.task import Task


class Schedule:
    """Recordings to prepare, and the tracks that can begin once their recording is prepared.

    Recordings are prepared one ahead of need: early enough that no worker waits, late enough that
    the first results come soon. A single process finishes recording after recording.
    """

    def __init__(self, tracks: Iterable[tuple[Task, list[Task]]]) -> None:
        """``tracks``: each recording's preparation, with the tracks that wait for it, in order."""
        self._waiting = dict(tracks)
        self._openings = deque(self._waiting)
        self._ready: deque[Task] = deque()

    @property
    def over(self) -> bool:
        """Whether no task is left to begin, now or later."""
        return not self._ready and not self._waiting

    def next(self, workers: int) -> Task | None:
        """Returns the next task; recordings are prepared until ``workers`` tracks are ready."""
        if self._openings and len(self._ready) < workers:
            return self._openings.popleft()
        return self._ready.popleft() if self._ready else None

    def opened(self, opening: Task) -> None:
        """Records that a recording is prepared."""
        self._ready.extend(self._waiting.pop(opening))

    def closed(self, opening: Task) -> list[Task]:
        """Drops and returns the tracks of a recording that cannot be prepared."""
        return self._waiting.pop(opening)
