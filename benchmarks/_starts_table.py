"""Tables of starts: shares of right ones, silent failures and false alarms."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from _starts_judge import Outcome

COLUMNS = (
    "cases",
    "right [%]",
    "far off",
    "of these found",
    "right ones doubted [%]",
    "median [s]",
    "95 % [s]",
)


@dataclass(frozen=True)
class Summary:
    """Figures of many starts.

    Attributes:
        percent: Share of right ones [%].
        silent: Number of those that are far off, and still have the verdict "found"; None if there
            is no verdict.
        doubted: Share of the right ones without this verdict [%]; None if there is no verdict, or
            no right one.
        seconds: Median processor time [s].
    """

    percent: float
    silent: int | None
    doubted: float | None
    seconds: float


def header(title: str) -> None:
    """Prints the head of a table."""
    print(f"\n| {title} | {' | '.join(COLUMNS)} |")
    print("|---|" + "--:|" * len(COLUMNS))


def row(name: str, outcomes: Sequence[Outcome], within: float, far: float) -> Summary:
    """Prints a row of the table and returns its figures.

    Args:
        name: Name of the row.
        outcomes: The starts.
        within: A start is right below this mean joint error [m].
        far: It is far off beyond this one [m].
    """
    errors = np.array([one.error for one in outcomes])
    sure = np.array([one.sure for one in outcomes])
    seconds = np.array([one.seconds for one in outcomes])
    right, off = errors < within, errors > far
    judged = all(one.verdict for one in outcomes)
    doubted = 100.0 * float((~sure[right]).mean()) if judged and right.any() else None
    found = Summary(
        round(100.0 * float(right.mean()), 1),
        int((off & sure).sum()) if judged else None,
        None if doubted is None else round(doubted, 1),
        round(float(np.median(seconds)), 3),
    )
    cells = (
        len(outcomes),
        found.percent,
        int(off.sum()),
        "-" if found.silent is None else found.silent,
        "-" if found.doubted is None else found.doubted,
        found.seconds,
        round(float(np.quantile(seconds, 0.95)), 3),
    )
    print(f"| {name} | {' | '.join(map(str, cells))} |", flush=True)
    return found


def parts(outcomes: Iterable[Outcome], within: float) -> None:
    """Prints the share of right starts by the parts of their cases' names, the worst first."""
    counts: dict[str, list[bool]] = {}
    for one in outcomes:
        for part in one.parts:
            counts.setdefault(part, []).append(one.error < within)
    shares = sorted((float(np.mean(right)), part) for part, right in counts.items())
    told = [f"{part} {100.0 * share:.0f} %" for share, part in shares if share < 1.0]
    print("\nright by part: " + ("; ".join(told) or "all"), flush=True)
