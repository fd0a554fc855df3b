"""The tables of a report, for a page, for Markdown and for a terminal."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from regkit.metrics import Measure, Pair, mean_of, summary
from regkit.metrics.pairs import Measures
from regkit.metrics.statistics import Interval
from regkit.report.words import BY_NAME, COLUMNS, NAMES, Column

TERMINAL = {
    "joint_error_raw_cm": "raw [cm]",
    "joint_error_adjusted_cm": "adj. [cm]",
    "pck_percent": "near [%]",
    "lost_frames": "lost",
    "surface_distance_mm": "surf. [mm]",
    "limit_violation_deg": "limits [°]",
    "fps": "fps",
}
"""The figures that a terminal of 80 characters has room for, and what it calls them."""


@dataclass(frozen=True)
class Cell:
    """One cell.

    Attributes:
        text: What is read.
        key: What it is sorted by, or None if it is unknown and stands last.
        best: Whether no other in its column is better.
        note: What stands below it, smaller.
        number: Whether it is a number, which stands to the right.
    """

    text: str
    key: float | str | None
    best: bool = False
    note: str = ""
    number: bool = True


@dataclass(frozen=True)
class Table:
    """A table that can be sorted.

    Attributes:
        name: Of its file.
        caption: What it shows.
        headings: Of the columns, with their units.
        rows: The cells.
    """

    name: str
    caption: str
    headings: list[str]
    rows: list[list[Cell]]


def shown(figure: float | None) -> str:
    """A figure as a person wants to read it in a terminal."""
    if figure is None:
        return "-"
    return f"{figure:.0f}" if float(figure).is_integer() else f"{figure:.1f}"


def rows(measures: Mapping[str, Mapping[str, Measure]]) -> list[list[str]]:
    """One row for each method: its name, the number of its recordings, and the mean figures."""
    table = []
    for method, by_recording in measures.items():
        if not by_recording:
            continue
        mean = mean_of(list(by_recording.values()))
        figures = [shown(getattr(mean, name)) for name in TERMINAL]
        table.append([method, str(len(by_recording)), *figures])
    return table


def main_table(measures: Measures) -> Table:
    """The methods' means, with the interval and the median of the joint errors."""
    finished = {name: list(by.values()) for name, by in measures.items() if by}
    means = {name: mean_of(found) for name, found in finished.items()}
    columns = _known(list(means.values()))
    alike = len({frozenset(by) for by in measures.values() if by}) == 1
    table = []
    for name, mean in means.items():
        cells = [
            Cell(name, name, number=False),
            Cell(str(len(finished[name])), len(finished[name])),
        ]
        for column in columns:
            value = getattr(mean, column.figure)
            note = ""
            if column.figure in NAMES:
                whole = summary([getattr(one, column.figure) for one in finished[name]])
                note = interval_text(whole.interval, column.digits)
            rivals = [getattr(one, column.figure) for one in means.values()]
            best = alike and _is_best(value, rivals, column)
            cells.append(Cell(column.shown(value), value, best, note))
        table.append(cells)
    return Table(
        "methods",
        "The mean of each figure over the recordings that a method finished; below it the 95 % "
        "bootstrap interval of the mean, where there are recordings enough."
        + ("" if alike else " Nothing is bold, for the methods finished different recordings."),
        ["method", "recordings", *(column.heading for column in columns)],
        table,
    )


def recording_table(measures: Measures) -> Table:
    """Every method on every recording."""
    each = [(m, s, one) for m, by in measures.items() for s, one in by.items()]
    columns = _known([one for _, _, one in each])
    table = []
    for method, recording, measure in each:
        cells = [Cell(recording, recording, number=False), Cell(method, method, number=False)]
        rivals = [one for _, name, one in each if name == recording]
        for column in columns:
            value = getattr(measure, column.figure)
            best = len(rivals) > 1 and _is_best(
                value, [getattr(one, column.figure) for one in rivals], column
            )
            cells.append(Cell(column.shown(value), value, best))
        table.append(cells)
    return Table(
        "recordings",
        "Every method on every recording; bold is the best method of a recording.",
        ["recording", "method", *(column.heading for column in columns)],
        table,
    )


def pair_table(pairs: list[Pair]) -> Table:
    """The tests between pairs of methods; of one recording alone they say nothing."""
    table = []
    if all(pair.n < 2 for pair in pairs):
        pairs = []
    for pair in pairs:
        digits = BY_NAME[pair.figure].digits
        tied = f", {pair.tied} the same" if pair.tied else ""
        table.append(
            [
                Cell(f"{pair.method} against {pair.other}", pair.method, number=False),
                Cell(BY_NAME[pair.figure].heading, pair.figure, number=False),
                Cell(f"{pair.won} of {pair.n}{tied}", pair.won / pair.n),
                Cell(
                    f"{pair.difference:+.{digits}f}",
                    pair.difference,
                    note=interval_text(pair.interval, digits),
                ),
                Cell(p_text(pair.p), pair.p),
                Cell(p_text(pair.p_holm), pair.p_holm),
            ]
        )
    return Table(
        "pairs",
        "The best method against each other one, methods that differ in their shape model alone, "
        "and pairs that were asked for: in how many recordings the first one is better, and by how "
        "much; a negative difference is in its favour.",
        ["pair", "figure", "won", "median difference", "p (Wilcoxon)", "p (Holm)"],
        table,
    )


def interval_text(interval: Interval | None, digits: int) -> str:
    """An interval, or nothing."""
    return "" if interval is None else f"{interval[0]:.{digits}f} … {interval[1]:.{digits}f}"


def p_text(p: float | None) -> str:
    """A p-value with sensible digits."""
    if p is None:
        return "-"
    return "< 0.001" if p < 0.001 else f"{p:.2g}" if p < 0.1 else f"{p:.2f}"


def _known(measures: list[Measure]) -> list[Column]:
    """The columns that anyone has a figure for; whole numbers alone have no digits."""
    columns = []
    for column in COLUMNS:
        values = [getattr(measure, column.figure) for measure in measures]
        known = [value for value in values if value is not None]
        if known:
            whole = all(float(value).is_integer() for value in known)
            columns.append(replace(column, digits=0) if whole else column)
    return columns


def _is_best(value: float | None, rivals: list[float | None], column: Column) -> bool:
    """Whether a value is as good as the best; where all are alike, nothing is said."""
    known = [round(rival, column.digits) for rival in rivals if rival is not None]
    if value is None or not column.better or len(set(known)) < 2:
        return False
    return round(value, column.digits) == (min if column.better == "less" else max)(known)
