"""Entry points of installed distributions, without importing them."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from functools import lru_cache
from importlib.metadata import EntryPoint, distributions
from pathlib import Path
from typing import Any

from regkit.system.errors import PluginError
from regkit.system.plugin_code import described

OWN = "regkit"
"""The distribution of the built-in plug-ins."""

_ONLY: ContextVar[str | None] = ContextVar("the only distribution that counts", default=None)


@dataclass(frozen=True)
class Installed:
    """The entry points of one name in a group.

    Attributes:
        points: The entry points of that name; with several, none of them is usable.
    """

    points: tuple[EntryPoint, ...]

    @property
    def distributions(self) -> tuple[str, ...]:
        """Names of the distributions that provide it."""
        return tuple(_brought_by(point) for point in self.points)

    @property
    def versions(self) -> str:
        """Names and versions of the distributions, for messages."""
        return " and ".join(
            f"{point.dist.name} {point.dist.version}" if point.dist else point.value
            for point in self.points
        )

    def load(self, what: str) -> Any:
        """Imports the object.

        Args:
            what: Its type in messages: plug-in or preset.

        Raises:
            PluginError: If it cannot be imported, or two distributions provide the name.
        """
        first = self.points[0]
        if len(self.points) > 1:
            rivals = " and ".join(f"{_brought_by(p)} ({p.value})" for p in self.points)
            raise PluginError(
                f"{what} '{first.name}' of {first.group} is provided by {rivals}; uninstall one of "
                "these distributions"
            )
        try:
            return first.load()
        except KeyboardInterrupt:
            raise
        # A module that exits the interpreter must not harm users who never name it.
        except BaseException as error:
            raise PluginError(
                f"{what} '{first.name}' of {_brought_by(first)} cannot be imported: "
                f"{described(error)}"
            ) from error


def installed(group: str) -> dict[str, Installed]:
    """Returns all entry points of a group by name."""
    only = _ONLY.get()
    found: dict[str, list[EntryPoint]] = {}
    for point in entry_points(group):
        if only is not None and not same_distribution(_brought_by(point), only):
            continue
        points = found.setdefault(point.name, [])
        # An editable distribution may appear twice.
        if all(other.value != point.value for other in points):
            points.append(point)
    # Sorting by distribution reads its files, which takes longer than everything else.
    return {
        name: Installed(tuple(sorted(points, key=_brought_by) if len(points) > 1 else points))
        for name, points in found.items()
    }


def entry_points(group: str) -> list[EntryPoint]:
    """Returns the entry points of a group from all distributions."""
    return all_entry_points().get(group, [])


def all_entry_points() -> dict[str, list[EntryPoint]]:
    """Returns the entry points of all distributions by group."""
    return _points(search_path())


def search_path() -> tuple[tuple[str, float], ...]:
    """Returns the search path of distributions, with the time of the last change of each folder."""
    return tuple((entry, folder.stat().st_mtime) for entry in sys.path
                 if (folder := Path(entry or ".")).exists())  # fmt: skip


@contextmanager
def only_from(distribution: str) -> Iterator[None]:
    """Context manager that hides the entry points of all other distributions."""
    token = _ONLY.set(distribution)
    try:
        yield
    finally:
        _ONLY.reset(token)


def same_distribution(name: str, other: str) -> bool:
    """Whether two names denote the same distribution after normalization."""
    return _normalized(name) == _normalized(other)


def _normalized(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


@lru_cache(maxsize=1)
def _points(_: tuple[tuple[str, float], ...]) -> dict[str, list[EntryPoint]]:
    """Returns all entry points by group; cached, since reading them is slow and frequent."""
    found: dict[str, list[EntryPoint]] = {}
    names: set[str] = set()
    for distribution in distributions():
        name = _normalized(distribution.name)
        if name in names:
            continue  # An earlier folder of the path takes precedence.
        names.add(name)
        for point in distribution.entry_points:
            found.setdefault(point.group, []).append(point)
    return found


def _brought_by(point: EntryPoint) -> str:
    return point.dist.name if point.dist else point.value
