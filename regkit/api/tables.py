"""Display of results: a line in Python, a table in a notebook or on a terminal."""

from __future__ import annotations

from abc import ABC, abstractmethod
from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.table import Table


class Summary(ABC):
    """Base of results that can be shown as a small table."""

    @abstractmethod
    def rows(self) -> dict[str, str]:
        """Returns the cells of the table by the names of their rows."""

    def __repr__(self) -> str:
        """Returns the table in one line."""
        cells = "; ".join(f"{name}: {value}" for name, value in self.rows().items())
        return f"<{type(self).__name__} {cells}>"

    def __rich__(self) -> Table:
        """Returns the table for a terminal."""
        from rich.markup import escape as plain
        from rich.table import Table

        table = Table(title=type(self).__name__, show_header=False)
        for name, value in self.rows().items():
            table.add_row(name, plain(value))
        return table

    def _repr_html_(self) -> str:
        """Returns the table as HTML for a notebook."""
        rows = "".join(
            f"<tr><th style='text-align:left'>{escape(name)}</th>"
            f"<td style='text-align:left'>{escape(value)}</td></tr>"
            for name, value in self.rows().items()
        )
        return f"<table><caption>{type(self).__name__}</caption>{rows}</table>"
