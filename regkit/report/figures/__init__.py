"""The figures of a report, one module each."""

from __future__ import annotations

from collections.abc import Iterator

from regkit.report.figures.bars import recording_bars, shape_bars
from regkit.report.figures.density import densities
from regkit.report.figures.joints import joint_dots
from regkit.report.figures.methods import method_means
from regkit.report.figures.thresholds import threshold_curves
from regkit.report.figures.time import errors_over_time
from regkit.report.figures.timing import timing_split
from regkit.report.plot import Plot
from regkit.report.run import Run


def plots(run: Run) -> Iterator[Plot]:
    """Yields all figures for which the results have data."""
    for make in (
        method_means,
        shape_bars,
        recording_bars,
        threshold_curves,
        joint_dots,
        errors_over_time,
        densities,
        timing_split,
    ):
        plot = make(run)
        if plot is not None:
            yield plot


__all__ = ["plots"]
