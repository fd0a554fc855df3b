"""The report as a self-contained HTML page, and as Markdown."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from urllib.parse import quote

from regkit.body.verdict import LOST_SHARE, SURE_COVERAGE, SURE_INLIERS
from regkit.metrics import mean_of
from regkit.metrics.pairs import best
from regkit.report.brief import brief, flow
from regkit.report.figures import plots
from regkit.report.labels import BY_NAME, NAMES, counted
from regkit.report.overlay import draw_overlay
from regkit.report.plot import DARK, LIGHT, Plot
from regkit.report.rendering import rendered
from regkit.report.run import Run
from regkit.report.summary import metrics, write_tables
from regkit.report.tables import main_table, pair_table, recording_table
from regkit.system.files import write_text
from regkit.system.json_files import write_json

PICTURES = 12
"""Maximum number of overlays on the page, those of each method's worst recordings; the others are
linked."""

ROWS = 40
"""Maximum number of rows of a table that is shown unfolded."""


@dataclass(frozen=True)
class Picture:
    """An overlay of a method on a recording.

    Attributes:
        method: Name of the method.
        recording: Name of the recording.
        file: Path of the image.
        link: URL of the image relative to the results folder.
    """

    method: str
    recording: str
    file: Path
    link: str


@dataclass(frozen=True)
class Drawn:
    """A plot, and its PNG images on light and dark background."""

    plot: Plot
    light: bytes
    dark: bytes


def write_summary(run: Run, folder: Path) -> None:
    """Writes ``metrics.json`` and ``report.md`` without figures, which is fast.

    Args:
        run: The results.
        folder: The results folder.

    Raises:
        DataError: If a file cannot be written.
    """
    write_json(folder / "metrics.json", metrics(run))
    write_text(folder / "report.md", _text("report.md", run, folder, []))


def write_report(
    run: Run, folder: Path, *, figures: bool = True, replay: str | None = None
) -> None:
    """Writes the complete report: HTML page, Markdown, figures, overlays, metrics and tables.

    Args:
        run: The results.
        folder: The results folder.
        figures: Whether to draw figures, which takes a few seconds.
        replay: Name of the replay beside the report, to which the page has a link.

    Raises:
        DataError: If a file cannot be written.
    """
    write_json(folder / "metrics.json", metrics(run))
    write_tables(run, folder / "tables")
    drawn = [Drawn(plot, plot.png(LIGHT), plot.png(DARK)) for plot in plots(run) if figures]
    for one in drawn:
        one.plot.write(folder / "figures", one.light)
    for picture in _pictures(run, folder):
        if not picture.file.exists() and picture.recording in run.records.get(picture.method, {}):
            draw_overlay(
                picture.file,
                f"{picture.method} on {picture.recording}",
                run.records[picture.method][picture.recording],
                run.style(picture.method).colour,
            )
    write_text(folder / "report.md", _text("report.md", run, folder, drawn, replay))
    write_text(folder / "report.html", _text("report.html", run, folder, drawn, replay))


def _text(
    template: str, run: Run, folder: Path, drawn: list[Drawn], replay: str | None = None
) -> str:
    pictures = list(_pictures(run, folder))
    worst = set(_worst(run))
    shown = [one for one in pictures if (one.method, one.recording) in worst and one.file.exists()]
    machine = run.environment
    return rendered(
        template,
        run=run,
        finding=_finding(run),
        compared=_compared(run),
        methods=brief(run.config.get("methods", {})),
        yaml=run.text,
        machine=[
            ("processor", machine.get("processor")),
            ("cores", machine.get("cores")),
            ("system", machine.get("system")),
            ("Python", machine.get("python")),
            ("regkit", machine.get("regkit")),
            *machine.get("libraries", {}).items(),
        ],
        run_at=machine.get("date"),
        written_at=f"{datetime.now():%Y-%m-%d %H:%M}",
        main=main_table(run.measures),
        pairs=pair_table(run.pairs()),
        recordings=recording_table(run.measures),
        folded=ROWS,
        doubts=[
            (m, s, one.verdict, one.reason)
            for m, by in run.measures.items()
            for s, one in by.items()
            if one.reason
        ],
        sure_inliers=SURE_INLIERS,
        sure_coverage=SURE_COVERAGE,
        lost_share=LOST_SHARE,
        failures=[(m, s, why) for m, by in run.failures.items() for s, why in by.items()],
        tracks=sum(len(by) for all_of in (run.measures, run.failures) for by in all_of.values()),
        figures=drawn,
        replay=replay,
        pictures=shown,
        others=[one for one in pictures if one not in shown and one.file.exists()],
        counted=counted,
    )  # fmt: skip


def _finding(run: Run) -> str:
    """Returns the result of the comparison in one sentence."""
    counts = (
        f"{counted(len(run.measures), 'method')} on {counted(len(run.recordings), 'recording')}"
    )
    first = best(run.finished, run.metric)
    if first is None:
        return f"{counts}."
    shared = [run.measures[first][recording] for recording in run.shared]
    column = BY_NAME[run.metric]
    least = f"{column.shown(getattr(mean_of(shared), run.metric))} {column.unit}"
    if len(run.finished) == 1:
        return f"{counts}: its {NAMES[run.metric]} is {least}."
    part = (
        ""
        if len(run.shared) == len(run.recordings)
        else f" on the {len(run.shared)} that all methods finished"
    )
    return f"{counts}: {first} has the least {NAMES[run.metric]}, {least}{part}."


def _compared(run: Run) -> list[tuple[str, str]]:
    parts = ("dataset", "template", "segmentation", "preprocessor", "tracker", "start")
    lines = [(name, flow(run.config.get(name))) for name in parts]
    return [(name, text) for name, text in lines if text]


def _worst(run: Run) -> Iterator[tuple[str, str]]:
    """Yields the methods and recordings whose overlays are shown: each method's worst."""
    if sum(map(len, run.finished.values())) <= PICTURES:
        each = len(run.recordings)
    else:
        each = max(1, PICTURES // max(1, len(run.finished)))
    for method in list(run.finished)[:PICTURES]:
        yield from ((method, recording) for recording in run.worst(method)[:each])


def _pictures(run: Run, folder: Path) -> Iterator[Picture]:
    for method, by_recording in run.finished.items():
        for recording in by_recording:
            place = Path(method, recording, "overlay.png")
            yield Picture(method, recording, folder / place, quote(place.as_posix()))
