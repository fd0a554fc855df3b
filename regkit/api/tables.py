"""How results show themselves: a line in Python, a small table in a notebook or by rich."""

from __future__ import annotations

from abc import ABC, abstractmethod
from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.table import Table


class Summary(ABC):
    """What can say of itself in a few rows what it is."""

    @abstractmethod
    def rows(self) -> dict[str, str]:
        """What a table says of it, by the rows' names."""

    def __repr__(self) -> str:
        """One line."""
        told = "; ".join(f"{name}: {value}" for name, value in self.rows().items())
        return f"<{type(self).__name__} {told}>"

    def __rich__(self) -> Table:
        """A table on a terminal."""
        from rich.markup import escape as plain
        from rich.table import Table

        table = Table(title=type(self).__name__, show_header=False)
        for name, value in self.rows().items():
            table.add_row(name, plain(value))
        return table

    def _repr_html_(self) -> str:
        """A table in a notebook."""
        rows = "".join(
            f"<tr><th style='text-align:left'>{escape(name)}</th>"
            f"<td style='text-align:left'>{escape(value)}</td></tr>"
            for name, value in self.rows().items()
        )
        return f"<table><caption>{type(self).__name__}</caption>{rows}</table>"
