"""The report's page, which needs no other file, and its Markdown twin."""

from __future__ import annotations

import base64
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from regkit.metrics import mean_of
from regkit.metrics.pairs import best
from regkit.report.brief import brief, flow
from regkit.report.figures import plots
from regkit.report.overlay import draw_overlay
from regkit.report.plot import DARK, LIGHT, Plot
from regkit.report.run import Run
from regkit.report.summary import metrics, write_tables
from regkit.report.tables import main_table, pair_table, recording_table
from regkit.report.words import BY_NAME, NAMES, many
from regkit.system.files import write_json, write_text

if TYPE_CHECKING:
    from jinja2 import Environment

PICTURES = 12
"""So many overlays are on the page, the worst recordings of each method, or the worst one of the
first methods; the others are linked."""

ROWS = 40
"""A table of more rows than this is folded up."""


@dataclass(frozen=True)
class Picture:
    """An overlay.

    Attributes:
        method: Of which method.
        recording: On which recording.
        file: Where it is.
        link: The same from the results folder, as a URL.
    """

    method: str
    recording: str
    file: Path
    link: str


@dataclass(frozen=True)
class Drawn:
    """A figure, and its pictures on light and dark paper."""

    plot: Plot
    light: bytes
    dark: bytes


def write_summary(run: Run, folder: Path) -> None:
    """Write the figures and ``report.md`` without pictures; it takes no time to speak of."""
    write_json(folder / "metrics.json", metrics(run))
    write_text(folder / "report.md", _text("report.md", run, folder, []))


def write_report(run: Run, folder: Path, *, figures: bool = True) -> None:
    """Write everything: the page, its Markdown twin, figures, pictures and numbers.

    Args:
        run: What was found.
        folder: Where to.
        figures: Whether figures are drawn, which takes some seconds.

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
    write_text(folder / "report.md", _text("report.md", run, folder, drawn))
    write_text(folder / "report.html", _text("report.html", run, folder, drawn))


def _text(template: str, run: Run, folder: Path, drawn: list[Drawn]) -> str:
    pictures = list(_pictures(run, folder))
    worst = set(_worst(run))
    shown = [one for one in pictures if (one.method, one.recording) in worst and one.file.exists()]
    machine = run.environment
    return _environment().get_template(template).render(
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
        failures=[(m, s, why) for m, by in run.failures.items() for s, why in by.items()],
        tracks=sum(len(by) for all_of in (run.measures, run.failures) for by in all_of.values()),
        figures=drawn,
        pictures=shown,
        others=[one for one in pictures if one not in shown and one.file.exists()],
        many=many,
    )  # fmt: skip


def _finding(run: Run) -> str:
    """The comparison in one sentence."""
    counts = f"{many(len(run.measures), 'method')} on {many(len(run.recordings), 'recording')}"
    first = best(run.finished, run.figure)
    if first is None:
        return f"{counts}."
    shared = [run.measures[first][recording] for recording in run.shared]
    column = BY_NAME[run.figure]
    least = f"{column.shown(getattr(mean_of(shared), run.figure))} {column.unit}"
    if len(run.finished) == 1:
        return f"{counts}: its {NAMES[run.figure]} is {least}."
    part = (
        "" if len(run.shared) == len(run.recordings) else f" on the {len(run.shared)} that all did"
    )
    return f"{counts}: {first} has the least {NAMES[run.figure]}, {least}{part}."


def _compared(run: Run) -> list[tuple[str, str]]:
    parts = ("dataset", "template", "preprocessor", "tracker", "start")
    lines = [(name, flow(run.config.get(name))) for name in parts]
    return [(name, text) for name, text in lines if text]


def _worst(run: Run) -> Iterator[tuple[str, str]]:
    """The overlays that are shown: of each method, the recordings that went worst."""
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


@cache
def _environment() -> Environment:
    from jinja2 import Environment, PackageLoader, StrictUndefined, select_autoescape

    environment = Environment(
        loader=PackageLoader("regkit.report"),
        autoescape=select_autoescape(["html"]),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    filters: dict[str, Any] = {
        "png": _embedded,
        "picture": lambda file: _embedded(file.read_bytes()),
        "md": _markdown,
    }
    environment.filters.update(filters)
    return environment


def _embedded(png: bytes) -> str:
    return "data:image/png;base64," + base64.b64encode(png).decode("ascii")


def _markdown(text: object) -> str:
    """Text that Markdown takes as it is, also in a table."""
    flat = " ".join(str(text).split())
    for special in "\\|*`[]<":
        flat = flat.replace(special, "\\" + special)
    return flat
