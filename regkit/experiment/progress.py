"""Who follows the progress of a run."""

from __future__ import annotations

from typing import Protocol

from regkit.system.errors import RegkitError


class Progress(Protocol):
    """Follows the progress of a run, and may end the run by raising ``KeyboardInterrupt``."""

    def planned(self, tracks: int, finished: int) -> None:
        """A run begins: its tracks (recordings times methods), and how many are finished."""

    def begin(self, label: str, frames: int | None) -> None:
        """A track of ``frames`` frames begins, or a recording is prepared."""

    def advance(self) -> None:
        """One more frame of the current track is done; workers do not report it."""

    def wait(self) -> None:
        """Nothing has ended for a moment; workers are busy."""

    def end(self, label: str, tracks: int, error: RegkitError | None) -> None:
        """What had begun has ended or failed, and with it this number of the planned tracks."""


class Silent(Progress):
    """Follows nothing."""

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
