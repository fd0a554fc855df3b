"""Names, units and number formats of metrics, and labels of figures."""

from __future__ import annotations

import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Column:
    """The column of a metric in a table.

    Attributes:
        metric: Name of the metric, a field of ``Measure``.
        title: Title of the column.
        unit: Unit, or empty.
        better: Whether ``less`` or ``more`` is better; empty if neither.
        digits: Number of decimals.
    """

    metric: str
    title: str
    unit: str
    better: str = ""
    digits: int = 1

    @property
    def heading(self) -> str:
        """The title with its unit."""
        return f"{self.title} [{self.unit}]" if self.unit else self.title

    def shown(self, value: float | None) -> str:
        """Returns a value as text."""
        return "-" if value is None else f"{value:.{self.digits}f}"


COLUMNS = (
    Column("joint_error_raw_cm", "raw", "cm", "less", 2),
    Column("joint_error_adjusted_cm", "adjusted", "cm", "less", 2),
    Column("pck_percent", "PCK", "%", "more"),
    Column("within_10cm_percent", "in 10 cm", "%", "more"),
    Column("auc_percent", "AUC", "%", "more"),
    Column("lost_frames", "lost", "frames", "less"),
    Column("recovery_s", "lost for", "s", digits=2),
    Column("found_percent", "found", "%", "more"),
    Column("inlier_percent", "inliers", "%"),
    Column("coverage_percent", "covered", "%"),
    Column("surface_distance_mm", "surface", "mm"),
    Column("marker_deviation_cm", "deviation", "cm", digits=2),
    Column("interval_coverage_percent", "in 90 %", "%"),
    Column("exchanged_percent", "exchanged", "%", "less"),
    Column("limit_violation_deg", "limits", "°", "less"),
    Column("evaluations_per_frame", "evaluations", "/frame"),
    Column("fps", "speed", "fps", "more"),
)
"""Columns of the report's tables.

Metrics that are not comparable between methods have no best value: the surface distance depends on
the preprocessor, the cost of an evaluation on the method, and the recovery time on the lost frames.
"""

BY_NAME = {column.metric: column for column in COLUMNS}

NAMES = {
    "joint_error_raw_cm": "mean joint error",
    "joint_error_adjusted_cm": "mean joint error, adjusted",
    "surface_distance_mm": "median distance of the data to the surface",
}
"""Full names of the metrics by which methods are compared."""


MAX_LABEL = 36
"""Maximum length of a name in a figure; tables and data files have the full names."""


def label(name: str) -> str:
    """Returns a name as label of a figure: shortened in the middle, without Matplotlib's maths."""
    half = (MAX_LABEL - 1) // 2
    shown = name if len(name) <= MAX_LABEL else f"{name[:half]}…{name[-half:]}"
    return shown.replace("$", r"\$")


def axis_label(metric: str) -> str:
    """Returns the label of an axis: the metric's name and unit."""
    return f"{NAMES[metric]} [{BY_NAME[metric].unit}]"


def counted(count: int, noun: str) -> str:
    """Returns a count with its noun: ``1 frame``, ``2 frames``."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def wrapped(name: str, width: int) -> str:
    """Returns a name wrapped to lines of at most ``width`` characters.

    Lines break after commas and slashes, the separators in the names of a sweep's variants; a line
    that is still too long breaks after underscores and hyphens, or anywhere.
    """
    whole = _broken(name, ",/", width)
    parts = [part for line in whole for part in _broken(line, "_-", width)]
    lines = [part[at : at + width] for part in parts for at in range(0, len(part), width)]
    return "\n".join(lines)


def _broken(line: str, after: str, width: int) -> list[str]:
    """Returns a line broken after some characters where it is too long."""
    lines = [""]
    for part in re.findall(rf"[^{after}]*[{after}]|[^{after}]+$", line):
        if lines[-1] and len(lines[-1]) + len(part) > width:
            lines.append("")
        lines[-1] += part
    return lines
