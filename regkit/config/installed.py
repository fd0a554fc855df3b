"""What distributions have installed under a name: entry points, none of them imported yet."""

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

OWN = "regkit"
"""The distribution that brings the built-ins."""

_ONLY: ContextVar[str | None] = ContextVar("the only distribution that counts", default=None)


@dataclass(frozen=True)
class Installed:
    """What is installed under one name of a group.

    Attributes:
        points: The entry points of that name; if there are several, none of them is usable.
    """

    points: tuple[EntryPoint, ...]

    @property
    def distributions(self) -> tuple[str, ...]:
        """The names of the distributions that bring it."""
        return tuple(_brought_by(point) for point in self.points)

    @property
    def versions(self) -> str:
        """The distributions with their versions, for people."""
        return " and ".join(
            f"{point.dist.name} {point.dist.version}" if point.dist else point.value
            for point in self.points
        )

    def load(self, what: str) -> Any:
        """Import it.

        Args:
            what: What it is called in messages: a plug-in, a preset.

        Raises:
            PluginError: If it cannot be imported, or two distributions claim the name.
        """
        first = self.points[0]
        if len(self.points) > 1:
            rivals = " and ".join(f"{_brought_by(p)} ({p.value})" for p in self.points)
            raise PluginError(
                f"{what} '{first.name}' of {first.group} is brought by {rivals}; uninstall one of "
                "these distributions"
            )
        try:
            return first.load()
        # A module that ends the interpreter must not end those who never named it.
        except (Exception, SystemExit) as error:
            # Some libraries go on with advice for whoever wrote the module, in further paragraphs.
            told = str(error).partition("\n\n")[0]
            raise PluginError(
                f"{what} '{first.name}' of {_brought_by(first)} cannot be imported: "
                f"{type(error).__name__}: {told}"
            ) from error


def installed(group: str) -> dict[str, Installed]:
    """All entry points of a group by name."""
    only = _ONLY.get()
    found: dict[str, list[EntryPoint]] = {}
    for point in entry_points(group):
        if only is not None and not same_distribution(_brought_by(point), only):
            continue
        points = found.setdefault(point.name, [])
        # An editable distribution may be seen twice.
        if all(other.value != point.value for other in points):
            points.append(point)
    # The name of a distribution is read from its files, which takes longer than all the rest.
    return {
        name: Installed(tuple(sorted(points, key=_brought_by) if len(points) > 1 else points))
        for name, points in found.items()
    }


def entry_points(group: str) -> list[EntryPoint]:
    """The entry points of a group, whoever brings them."""
    return _points(_path()).get(group, [])


@contextmanager
def only_from(distribution: str) -> Iterator[None]:
    """A context in which what other distributions bring is not there."""
    token = _ONLY.set(distribution)
    try:
        yield
    finally:
        _ONLY.reset(token)


def same_distribution(name: str, other: str) -> bool:
    """Whether two names are of one distribution, as package indexes compare them."""
    return _normalized(name) == _normalized(other)


def _normalized(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def _path() -> tuple[tuple[str, float], ...]:
    """Where distributions are looked for, and when something was last installed there."""
    return tuple((entry, folder.stat().st_mtime) for entry in sys.path
                 if (folder := Path(entry or ".")).exists())  # fmt: skip


@lru_cache(maxsize=1)
def _points(_: tuple[tuple[str, float], ...]) -> dict[str, list[EntryPoint]]:
    """Every entry point by its group; to read them takes a moment, and every slot asks for them."""
    found: dict[str, list[EntryPoint]] = {}
    names: set[str] = set()
    for distribution in distributions():
        name = _normalized(distribution.name)
        if name in names:
            continue  # An earlier folder of the path hides it.
        names.add(name)
        for point in distribution.entry_points:
            found.setdefault(point.group, []).append(point)
    return found


def _brought_by(point: EntryPoint) -> str:
    return point.dist.name if point.dist else point.value
