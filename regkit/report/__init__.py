"""Reports: tables and pictures of what a run found."""

from regkit.report.overlay import draw_overlay
from regkit.report.tables import report

__all__ = ["draw_overlay", "report"]
