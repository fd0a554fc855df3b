"""What autodoc shows of this project's code.

Docstrings of attributes are prose, in which Napoleon would take what stands before a colon for a
type. A configuration model is made from YAML; its fields are listed, and its call is left out.
"""

from __future__ import annotations

from typing import Any

from sphinx.application import Sphinx

from regkit.config.model import Model

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


def _no_call(
    app: Sphinx, what: str, name: str, obj: Any, options: Any, signature: str, returned: str
) -> tuple[str, str] | None:
    return ("", "") if isinstance(obj, type) and issubclass(obj, Model) else None


def setup(app: Sphinx) -> dict[str, bool]:
    """The priority of Napoleon is 500."""
    kept = _Kept()
    app.connect("autodoc-process-docstring", kept.keep, priority=400)
    app.connect("autodoc-process-docstring", kept.restore, priority=600)
    app.connect("autodoc-process-signature", _no_call)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
