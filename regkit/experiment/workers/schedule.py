"""What is done next."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable

from regkit.experiment.task import Task


class Schedule:
    """Recordings that are to be made ready, and the tracks that may begin once theirs is.

    Recordings are made ready one ahead of need: early enough that no worker waits, and late enough
    that the first results come soon. One process does recording after recording.
    """

    def __init__(self, tracks: Iterable[tuple[Task, list[Task]]]) -> None:
        """The task that makes a recording ready, and the tracks that wait for it, in order."""
        self._waiting = dict(tracks)
        self._openings = deque(self._waiting)
        self._ready: deque[Task] = deque()

    @property
    def over(self) -> bool:
        """Whether nothing is left that could be begun, now or later."""
        return not self._ready and not self._waiting

    def next(self, workers: int) -> Task | None:
        """The task to begin now; recordings are prepared until ``workers`` tracks are ready."""
        if self._openings and len(self._ready) < workers:
            return self._openings.popleft()
        return self._ready.popleft() if self._ready else None

    def opened(self, opening: Task) -> None:
        """A recording is ready."""
        self._ready.extend(self._waiting.pop(opening))

    def closed(self, opening: Task) -> list[Task]:
        """A recording cannot be made ready; its tracks are dropped and returned."""
        return self._waiting.pop(opening)
