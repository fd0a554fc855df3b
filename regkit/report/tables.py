"""The figures of a run as Markdown."""

from __future__ import annotations

from collections.abc import Mapping

from regkit.metrics import Measure, mean_of

COLUMNS = {
    "joint_error_raw_cm": "raw [cm]",
    "joint_error_adjusted_cm": "adj. [cm]",
    "near_percent": "near [%]",
    "lost_frames": "lost",
    "surface_distance_mm": "surf. [mm]",
    "limit_violation_deg": "limits [°]",
    "fps": "fps",
}
"""The figures that are shown, and what a table calls them."""


def shown(figure: float | None) -> str:
    """A figure as a person wants to read it."""
    if figure is None:
        return "-"
    return f"{figure:.0f}" if float(figure).is_integer() else f"{figure:.1f}"


def rows(measures: Mapping[str, Mapping[str, Measure]]) -> list[list[str]]:
    """One row for each method: its name, the number of its sequences, and the mean figures."""
    table = []
    for method, by_sequence in measures.items():
        if not by_sequence:
            continue
        mean = mean_of(list(by_sequence.values()))
        figures = [shown(getattr(mean, name)) for name in COLUMNS]
        table.append([method, str(len(by_sequence)), *figures])
    return table


def report(
    name: str,
    measures: Mapping[str, Mapping[str, Measure]],
    failures: Mapping[str, Mapping[str, str]],
) -> str:
    """A run as Markdown: the methods' means, what failed, and each sequence with its picture."""
    parts = [f"# {name}", _table(["method", "sequences", *COLUMNS.values()], rows(measures))]
    parts.append(
        "*Raw* and *adj.* (adjusted) are mean distances of the body's markers to the reference "
        "joints, adjusted after each marker's constant displacement in its segment is subtracted; "
        "*near* is how many raw distances are below 6 % of the body's size (10 cm on a person). A "
        "frame is *lost* when less than half of its joints are that near. *Surf.* is the median "
        "distance of the observed points (after averaging in voxels or leaves) to the body's "
        "surface, *limits* the mean of each frame's largest violation of a joint limit, *fps* the "
        "frames observed and registered in a second. A dash is a figure that cannot be had."
    )
    failed = [(m, s, why) for m, by in failures.items() for s, why in by.items()]
    if failed:
        parts.append("## Failed")
        parts += [f"- **{method}** on {sequence}: {why}" for method, sequence, why in failed]
    for method, by_sequence in measures.items():
        if not by_sequence:
            continue
        parts.append(f"## {method}")
        table = [
            [sequence, *(shown(getattr(measure, figure)) for figure in COLUMNS)]
            for sequence, measure in by_sequence.items()
        ]
        parts.append(_table(["sequence", *COLUMNS.values()], table))
        parts += [
            f"![{method} on {sequence}]({method}/{sequence}/overlay.png)"
            for sequence in by_sequence
        ]
    return "\n\n".join(parts) + "\n"


def _table(header: list[str], body: list[list[str]]) -> str:
    rule = ["---", *["---:"] * (len(header) - 1)]
    return "\n".join("| " + " | ".join(row) + " |" for row in [header, rule, *body])
