"""Reports: tables, figures and overlays of an experiment's results, as HTML page and Markdown."""

from regkit.report.overlay import draw_overlay
from regkit.report.page import write_report, write_summary
from regkit.report.record import Record
from regkit.report.run import Run, method_styles

__all__ = ["Record", "Run", "draw_overlay", "method_styles", "write_report", "write_summary"]
