"""Observers of a run's progress."""

from __future__ import annotations

from typing import Protocol

from regkit.system.errors import RegkitError


class Progress(Protocol):
    """Observes a run's progress, and may end the run by raising ``KeyboardInterrupt``."""

    def planned(self, tracks: int, finished: int) -> None:
        """Called once with the numbers of all and of finished tracks (recordings times methods)."""

    def begin(self, label: str, frames: int | None) -> None:
        """Called when a track of ``frames`` frames, or the preparation of a recording, begins."""

    def advance(self) -> None:
        """Called after each frame of the current track, except by workers."""

    def wait(self) -> None:
        """Called regularly while workers are busy."""

    def end(self, label: str, tracks: int, error: RegkitError | None) -> None:
        """Called when a task ends or fails, with the number of planned tracks that end with it."""


class Silent(Progress):
    """Observes nothing."""

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
