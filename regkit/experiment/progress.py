"""Who is told how far a run is."""

from __future__ import annotations

from typing import Protocol

from regkit.system.errors import RegkitError


class Progress(Protocol):
    """Who wants to know how far a run is, and may end it by raising ``KeyboardInterrupt``."""

    def planned(self, tracks: int, finished: int) -> None:
        """A run begins: so many recordings times methods, of which some were finished before."""

    def begin(self, label: str, frames: int | None) -> None:
        """A track of so many frames is begun, or a recording is made ready."""

    def advance(self) -> None:
        """One more frame is done of the only thing that is being done; workers do not tell."""

    def wait(self) -> None:
        """Nothing has ended for a moment; workers are busy."""

    def end(self, label: str, tracks: int, error: RegkitError | None) -> None:
        """What was begun has ended, or failed, and with it so many of the planned tracks."""


class Silent(Progress):
    """Wants to know nothing."""

    def planned(self, tracks: int, finished: int) -> None:
        """Nothing."""

    def begin(self, label: str, frames: int | None) -> None:
        """Nothing."""

    def advance(self) -> None:
        """Nothing."""

    def wait(self) -> None:
        """Nothing."""

    def end(self, label: str, tracks: int, error: RegkitError | None) -> None:
        """Nothing."""
