"""How figures are called and written for people."""

from __future__ import annotations

import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Column:
    """A figure in a table.

    Attributes:
        figure: Its name in ``Measure``.
        title: What it is called.
        unit: Its unit, or nothing.
        better: ``less`` or ``more`` of it is better, or nothing is said.
        digits: After the decimal point.
    """

    figure: str
    title: str
    unit: str
    better: str = ""
    digits: int = 1

    @property
    def heading(self) -> str:
        """The title with its unit."""
        return f"{self.title} [{self.unit}]" if self.unit else self.title

    def shown(self, value: float | None) -> str:
        """A value as a person wants to read it."""
        return "-" if value is None else f"{value:.{self.digits}f}"


COLUMNS = (
    Column("joint_error_raw_cm", "raw", "cm", "less", 2),
    Column("joint_error_adjusted_cm", "adjusted", "cm", "less", 2),
    Column("pck_percent", "near", "%", "more"),
    Column("within_10cm_percent", "in 10 cm", "%", "more"),
    Column("auc_percent", "area", "%", "more"),
    Column("lost_frames", "lost", "frames", "less"),
    Column("recovery_s", "lost for", "s", digits=2),
    Column("surface_distance_mm", "surface", "mm"),
    Column("limit_violation_deg", "limits", "°", "less"),
    Column("evaluations_per_frame", "evaluations", "/frame"),
    Column("fps", "speed", "fps", "more"),
)
"""The figures of the page's tables; what counts as better where a surface distance depends on the
preprocessor, evaluations cost differently, and only who was lost has a time, is left to the
reader."""

BY_NAME = {column.figure: column for column in COLUMNS}

NAMES = {
    "joint_error_raw_cm": "mean joint error",
    "joint_error_adjusted_cm": "mean joint error, adjusted",
    "surface_distance_mm": "median distance of the data to the surface",
}
"""The figures that methods are compared in, in full."""


LONGEST = 36
"""A figure has no room for longer names; its numbers and the tables have them in full."""


def label(name: str) -> str:
    """A name as a figure shows it: the middle of a long one left out, and no mathematics in it."""
    half = (LONGEST - 1) // 2
    shown = name if len(name) <= LONGEST else f"{name[:half]}…{name[-half:]}"
    return shown.replace("$", r"\$")


def axis_label(figure: str) -> str:
    """A figure with its unit, as an axis is labelled."""
    return f"{NAMES[figure]} [{BY_NAME[figure].unit}]"


def many(count: int, what: str) -> str:
    """A number of things: ``1 frame``, ``2 frames``."""
    return f"{count} {what}" if count == 1 else f"{count} {what}s"


def broken(name: str, most: int) -> str:
    """A name in lines of at most so many letters, where its commas and slashes let it be broken.

    Those are what the names of a sweep's variants are made with.
    """
    lines = [""]
    for part in re.findall(r"[^,/]*[,/]|[^,/]+$", name):
        if lines[-1] and len(lines[-1]) + len(part) > most:
            lines.append("")
        lines[-1] += part
    return "\n".join(lines)
