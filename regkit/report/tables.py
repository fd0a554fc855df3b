"""Tables of a report, for HTML, Markdown and the terminal."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from regkit.metrics import Measure, Pair, mean_of, summary
from regkit.metrics.pairs import Measures
from regkit.metrics.statistics import Interval
from regkit.report.labels import BY_NAME, COLUMNS, NAMES, Column

TERMINAL = {
    "joint_error_raw_cm": "raw [cm]",
    "joint_error_adjusted_cm": "adj. [cm]",
    "pck_percent": "PCK [%]",
    "lost_frames": "lost",
    "found_percent": "found [%]",
    "surface_distance_mm": "surf. [mm]",
    "fps": "fps",
}
"""Metrics and headings of the table in a terminal of 80 characters."""


@dataclass(frozen=True)
class Cell:
    """A cell of a table.

    Attributes:
        text: Displayed text.
        key: Sort key; None for an unknown value, which sorts last.
        best: Whether no other value in its column is better.
        note: Smaller text below.
        number: Whether it is a number, which is right-aligned.
    """

    text: str
    key: float | str | None
    best: bool = False
    note: str = ""
    number: bool = True


@dataclass(frozen=True)
class Table:
    """A sortable table.

    Attributes:
        name: Identifier of the table.
        caption: Caption.
        headings: Headings of the columns, with units.
        rows: The cells.
    """

    name: str
    caption: str
    headings: list[str]
    rows: list[list[Cell]]


def shown(metric: float | None) -> str:
    """Returns a metric as text for the terminal."""
    if metric is None:
        return "-"
    return f"{metric:.0f}" if float(metric).is_integer() else f"{metric:.1f}"


def rows(measures: Mapping[str, Mapping[str, Measure]]) -> list[list[str]]:
    """Returns a row for each method: name, number of recordings, and mean metrics."""
    table = []
    for method, by_recording in measures.items():
        if not by_recording:
            continue
        mean = mean_of(list(by_recording.values()))
        metrics = [shown(getattr(mean, name)) for name in TERMINAL]
        table.append([method, str(len(by_recording)), *metrics])
    return table


def main_table(measures: Measures) -> Table:
    """Returns the table of each method's mean metrics, with intervals of the main ones."""
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
            value = getattr(mean, column.metric)
            note = ""
            if column.metric in NAMES:
                whole = summary([getattr(one, column.metric) for one in finished[name]])
                note = interval_text(whole.interval, column.digits)
            rivals = [getattr(one, column.metric) for one in means.values()]
            best = alike and _is_best(value, rivals, column)
            cells.append(Cell(column.shown(value), value, best, note))
        table.append(cells)
    return Table(
        "methods",
        "The mean of each metric over the recordings that a method finished, and below it the 95 % "
        "bootstrap interval of the mean if there are enough recordings."
        + ("" if alike else " Nothing is bold because the methods finished different recordings."),
        ["method", "recordings", *(column.heading for column in columns)],
        table,
    )


def recording_table(measures: Measures) -> Table:
    """Returns the table of every method on every recording."""
    each = [(m, s, one) for m, by in measures.items() for s, one in by.items()]
    columns = _known([one for _, _, one in each])
    table = []
    for method, recording, measure in each:
        verdict = str(measure.verdict or "-")
        cells = [Cell(text, text, number=False) for text in (recording, method, verdict)]
        rivals = [one for _, name, one in each if name == recording]
        for column in columns:
            value = getattr(measure, column.metric)
            best = len(rivals) > 1 and _is_best(
                value, [getattr(one, column.metric) for one in rivals], column
            )
            cells.append(Cell(column.shown(value), value, best))
        table.append(cells)
    return Table(
        "recordings",
        "Every method on every recording; the best method of a recording is bold.",
        ["recording", "method", "verdict", *(column.heading for column in columns)],
        table,
    )


def pair_table(pairs: list[Pair]) -> Table:
    """Returns the table of pairwise comparisons, without rows for a single recording."""
    table = []
    if all(pair.n < 2 for pair in pairs):
        pairs = []
    for pair in pairs:
        digits = BY_NAME[pair.metric].digits
        tied = f", {pair.tied} the same" if pair.tied else ""
        table.append(
            [
                Cell(f"{pair.method} against {pair.other}", pair.method, number=False),
                Cell(BY_NAME[pair.metric].heading, pair.metric, number=False),
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
        "The best method against each other one, methods that differ in their shape model only, "
        "and selected pairs: the number of recordings on which the first method is better, and the "
        "difference; a negative difference is in its favour.",
        ["pair", "metric", "won", "median difference", "p (Wilcoxon)", "p (Holm)"],
        table,
    )


def interval_text(interval: Interval | None, digits: int) -> str:
    """Returns an interval as text; empty for None."""
    return "" if interval is None else f"{interval[0]:.{digits}f} … {interval[1]:.{digits}f}"


def p_text(p: float | None) -> str:
    """Returns a p-value as text."""
    if p is None:
        return "-"
    return "< 0.001" if p < 0.001 else f"{p:.2g}" if p < 0.1 else f"{p:.2f}"


def _known(measures: list[Measure]) -> list[Column]:
    """Returns the columns with a known value; columns of whole numbers have no decimals."""
    columns = []
    for column in COLUMNS:
        values = [getattr(measure, column.metric) for measure in measures]
        known = [value for value in values if value is not None]
        if known:
            whole = all(float(value).is_integer() for value in known)
            columns.append(replace(column, digits=0) if whole else column)
    return columns


def _is_best(value: float | None, rivals: list[float | None], column: Column) -> bool:
    """Returns whether a value equals the best one; False if all values are equal."""
    known = [round(rival, column.digits) for rival in rivals if rival is not None]
    if value is None or not column.better or len(set(known)) < 2:
        return False
    return round(value, column.digits) == (min if column.better == "less" else max)(known)
