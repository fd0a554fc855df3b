"""Adjustments of autodoc for this project.

Docstrings of attributes are prose, in which Napoleon would parse text before a colon as a type.
Configuration models are created from YAML, so their call signature is omitted.
"""

from __future__ import annotations

from typing import Any

from sphinx.application import Sphinx

from regkit.config.model import Model

PROSE = ("attribute", "data", "property")


class _Kept:
    """Keeps a docstring before Napoleon processes it, and restores it afterwards."""

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


def _no_call(
    app: Sphinx, what: str, name: str, obj: Any, options: Any, signature: str, returned: str
) -> tuple[str, str] | None:
    return ("", "") if isinstance(obj, type) and issubclass(obj, Model) else None


def setup(app: Sphinx) -> dict[str, bool]:
    """Connects the handlers; Napoleon has the priority 500."""
    kept = _Kept()
    app.connect("autodoc-process-docstring", kept.keep, priority=400)
    app.connect("autodoc-process-docstring", kept.restore, priority=600)
    app.connect("autodoc-process-signature", _no_call)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
