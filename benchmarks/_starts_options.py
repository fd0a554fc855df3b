"""Options of the starts' benchmark, and how its cases are run."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from typing import TypeVar

from _starts_bodies import Set
from rich.console import Console
from rich.progress import track

Item = TypeVar("Item")

Result = TypeVar("Result")


@dataclass(frozen=True)
class Options:
    """Options of a run.

    Attributes:
        start: Name of the search.
        chosen: The set of bodies and motions.
        some: Greatest number of cases of a scenario, chosen at random.
        seed: Seed of this choice.
        jobs: Number of processes.
        each: Whether every case is printed.
    """

    start: str
    chosen: Set
    some: int
    seed: int = 0
    jobs: int = 1
    each: bool = False

    def mapped(
        self, what: str, function: Callable[[Item], Result], items: Iterable[Item]
    ) -> list[Result]:
        """Returns a function's results, in one process or several; each has one thread."""
        given = list(items)
        if self.jobs == 1:
            return self._shown(what, map(function, given), len(given))
        with ProcessPoolExecutor(self.jobs) as pool:
            return self._shown(what, pool.map(function, given), len(given))

    def _shown(self, what: str, results: Iterable[Result], count: int) -> list[Result]:
        """Returns the results, with a progress bar or a line for each."""
        console = Console(stderr=True)
        hidden = self.each or not console.is_terminal
        found = []
        for result in track(results, what, count, console=console, transient=True, disable=hidden):
            found.append(result)
            if self.each:
                print(result, flush=True)
        return found
