"""Docstrings of attributes are prose, which Napoleon leaves as it is.

It would take what stands before a colon for a type.
"""

from __future__ import annotations

from typing import Any

from sphinx.application import Sphinx

PROSE = ("attribute", "data", "property")


class _Kept:
    """What a docstring was before Napoleon, and is again after it."""

    def __init__(self) -> None:
        self._lines: list[str] = []

    def keep(self, app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: Any) -> None:
        if what in PROSE:
            self._lines = list(lines)

    def restore(
        self, app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: Any
    ) -> None:
        if what in PROSE:
            lines[:] = self._lines


def setup(app: Sphinx) -> dict[str, bool]:
    """Stand before and after Napoleon, whose priority is 500."""
    kept = _Kept()
    app.connect("autodoc-process-docstring", kept.keep, priority=400)
    app.connect("autodoc-process-docstring", kept.restore, priority=600)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
