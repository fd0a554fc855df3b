"""What ``metrics.json`` tells of the tracks of a run."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Self

from pydantic import TypeAdapter

from regkit.system.guard import reading


@dataclass(frozen=True)
class MethodEntry:
    """The metrics of a method, or the reason of a failure under ``error``, by recording."""

    recordings: dict[str, dict[str, Any]] = field(default_factory=dict)


@dataclass(frozen=True)
class SummaryFile:
    """The methods and recordings of ``metrics.json``, in their order.

    Attributes:
        methods: Entries by method.
    """

    methods: dict[str, MethodEntry] = field(default_factory=dict)

    @classmethod
    def read(cls, folder: Path) -> Self:
        """Returns the summary in a results folder; empty before the first one is written.

        Raises:
            DataError: If the file is damaged.
        """
        file = folder / "metrics.json"
        if not file.exists():
            return cls()
        with reading(file, "a metrics file of regkit run"):
            summary: Self = TypeAdapter(cls).validate_json(file.read_bytes())
            return summary

    def failures(self) -> dict[str, dict[str, str]]:
        """Returns the reasons of failures by method and recording."""
        return {
            method: {
                name: str(one["error"]) for name, one in entry.recordings.items() if "error" in one
            }
            for method, entry in self.methods.items()
        }
